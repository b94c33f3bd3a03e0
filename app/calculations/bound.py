"""What one calculation may use."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Bound:
    """The bounds of a calculation, and how people call it and shorten it.

    `seconds` is processor time. `megabytes` is memory beyond that of a process without work. `patience_s` is wall time: a
    loaded machine may need more than `seconds`. `long` calculations wait for each other
    and leave the places of short ones free. `where` is the field of the request that the error names.
    """

    noun: str
    seconds: int
    megabytes: int
    mend: str
    long: bool = False
    where: str = ""

    @property
    def patience_s(self) -> float:
        return 30.0 + 4.0 * self.seconds
