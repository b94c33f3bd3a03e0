"""Structures: parts whose `assemble()` returns matrices, floors, storey drifts and inelastic members."""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.structures.matrices import MatricesStructure
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.parts.structures.no_structure import NoStructure
from rths_engine.parts.structures.shear_building import ShearBuilding

Structure = Annotated[
    ShearBuilding | MomentFrame | MatricesStructure | NoStructure,
    Field(discriminator="kind"),
]
KINDS = kinds(Structure)
