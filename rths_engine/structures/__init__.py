"""Structures: parts that give M, C, K, the drift row of each storey and the floors' degrees of freedom."""

from typing import Annotated

from pydantic import Field

from rths_engine.structures.shear_building import ShearBuilding, Storey

KINDS = (ShearBuilding,)
Structure = Annotated[ShearBuilding, Field()]

__all__ = ["KINDS", "ShearBuilding", "Storey", "Structure"]
