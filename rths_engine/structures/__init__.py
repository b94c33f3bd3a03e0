"""Structures: parts whose `assemble()` gives matrices, floors, storey drifts and inelastic members."""

from typing import Annotated

from pydantic import Field

from rths_engine.structures.matrices import MatricesStructure
from rths_engine.structures.moment_frame import MomentFrame
from rths_engine.structures.no_structure import NoStructure
from rths_engine.structures.shear_building import ShearBuilding

KINDS = (ShearBuilding, MomentFrame, MatricesStructure, NoStructure)
Structure = Annotated[ShearBuilding | MomentFrame | MatricesStructure | NoStructure, Field(discriminator="kind")]
