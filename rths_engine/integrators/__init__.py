"""Integrators: parts that turn M, C, K into the matrix M_e with M_e beta a = F - C v - r."""

from typing import Annotated

from pydantic import Field

from rths_engine.integrators.cr import CrIntegrator

KINDS = (CrIntegrator,)
Integrator = Annotated[CrIntegrator, Field()]
