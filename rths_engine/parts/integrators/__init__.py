"""Integrators: parts that convert M, C and K to the scheme that the loop executes."""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.integrators.central_difference import CentralDifference
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.integrators.kr_alpha import KrAlphaIntegrator
from rths_engine.parts.integrators.newmark import ExplicitNewmark

Integrator = Annotated[
    CrIntegrator | KrAlphaIntegrator | ExplicitNewmark | CentralDifference,
    Field(discriminator="kind"),
]
KINDS = kinds(Integrator)
