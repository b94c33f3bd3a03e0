"""Forms of the answers about readiness."""

from __future__ import annotations

from pydantic import BaseModel, Field

UNTOLD = "Sign in, or send an API token, to read the reason."


class Check(BaseModel):
    """One thing that the service needs to accept and execute tests."""

    name: str = Field(description="database, schema, store, disk, worker or clock")
    ok: bool
    reason: str = Field(description="what was found, and how to mend it where `ok` is false; only for people who are signed in")


class Readiness(BaseModel):
    """Whether the service can accept and execute tests, and each check with its reason."""

    ready: bool
    checks: list[Check]

    def without_reasons(self) -> Readiness:
        """The names of the checks that failed, for people who are not signed in."""
        failed = [Check(name=one.name, ok=False, reason=UNTOLD) for one in self.checks if not one.ok]
        return Readiness(ready=self.ready, checks=failed)
