"""JSON forms of the laboratory's identity."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.text import Storable
from app.whole import Whole

ROLES = ("Test operator", "Checked by", "Approved by")
Role = Annotated[Storable, Field(min_length=1, max_length=60)]


class Identity(BaseModel):
    """Name, address line and signatures of the laboratory."""

    model_config = ConfigDict(extra="forbid")

    name: Storable = Field("", max_length=120, description="name of the laboratory, in the header of every report")
    address: Storable = Field("", max_length=200, description="address line under the name")
    signatures: list[Role] = Field([*ROLES], max_length=6, description="role of each person who signs a report")


class IdentityIn(Identity, Whole):
    """The identity to set: every field is given, so that none is emptied by leaving it out."""


class Logo(BaseModel):
    """Type, size (bytes) and checksum of the logo."""

    media_type: str
    size: int
    sha256: str


class LaboratoryOut(Identity):
    """The laboratory's identity, with its logo if there is one."""

    logo: Logo | None
