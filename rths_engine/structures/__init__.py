"""Structures: parts whose `assemble()` gives matrices, floors, storey drifts and inelastic members."""

from typing import Annotated

from pydantic import Field

from rths_engine.structures.moment_frame import MomentFrame
from rths_engine.structures.shear_building import ShearBuilding

KINDS = (ShearBuilding, MomentFrame)
Structure = Annotated[ShearBuilding | MomentFrame, Field(discriminator="kind")]
