"""Forms of the answers about readiness."""

from __future__ import annotations

from pydantic import BaseModel, Field


class Check(BaseModel):
    """One thing that the service needs to accept and execute tests."""

    name: str = Field(description="database, schema, store, disk, worker or clock")
    ok: bool
    reason: str = Field(description="what was found, and how to mend it where `ok` is false")


class Readiness(BaseModel):
    """Whether the service can accept and execute tests, and each check with its reason."""

    ready: bool
    checks: list[Check]
