"""Times in requests."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated

from pydantic import AfterValidator


def in_utc(time: datetime) -> datetime:
    """A time in UTC; without a time zone it is UTC. Raises ValueError where UTC has no such year."""
    try:
        return time.replace(tzinfo=UTC) if time.tzinfo is None else time.astimezone(UTC)
    except OverflowError:
        raise ValueError("is out of range: needs a year from 1 to 9999") from None


InUtc = Annotated[datetime, AfterValidator(in_utc)]
"""A time of a query or a body, in UTC."""
