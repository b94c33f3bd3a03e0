"""JSON forms of the audit log."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from pydantic import BaseModel, Field


class RunNamed(BaseModel):
    """The run that an entry is about."""

    id: str
    number: int
    name: str


class AuditOut(BaseModel):
    """One entry: who did what, to what, and when."""

    number: int = Field(description="number of the entry, from 1 without gaps")
    at: datetime = Field(description="time of the action, UTC")
    who: str = Field(description="account, or the name that the request gave; empty: nobody was named")
    role: str = Field(description="role of the person at that time; `worker` for a worker")
    signed_in: str = Field(description="how the person had signed in")
    action: str = Field(description="what was done: `runs.submit`, `queue.hold`; `refused.` before an action that was refused")
    about: str = Field(description="what it was done to, `run:ID`; empty for the whole")
    run: RunNamed | None = Field(description="the run of `about`, where it still exists")
    details: dict[str, Any] = Field(description="request or event, without secrets")
    previous: str = Field(description="hash of the entry before, hexadecimal")
    hash: str = Field(description="SHA-256 of `previous` and the canonical JSON of the entry, hexadecimal")


class HeadOut(BaseModel):
    """The last entry. Note number and hash elsewhere: a check against them detects a log whose end was cut off."""

    number: int
    hash: str
    text: str = Field(description="NUMBER:HASH, as `rths audit check --head` and `GET /audit/check?head=` take it")


class AuditList(BaseModel):
    """Entries, newest first."""

    entries: list[AuditOut]
    total: int = Field(description="number of entries that match, also those on other pages")
    head: HeadOut


class BrokenOut(BaseModel):
    """The first entry that does not fit the chain, and why."""

    number: int
    problem: str


class ChainOut(BaseModel):
    """The result of a check of the whole chain."""

    whole: bool
    entries: int = Field(description="number of entries that fit the chain")
    head: HeadOut = Field(description="the last entry that fits the chain")
    broken: BrokenOut | None
    sentence: str
    checked_at: datetime
