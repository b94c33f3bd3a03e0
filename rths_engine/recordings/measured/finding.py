"""The result of a check of a file of measurements."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from rths_engine.foundation.errors import Issue


@dataclass(frozen=True, slots=True)
class Finding:
    """A finding of a check. An error prevents the import; the recording stores warnings. `time_s`: start in the file's time."""

    severity: Literal["error", "warning"]
    channel: str
    problem: str
    value: str = ""
    time_s: float | None = None
    fix: str = ""

    @property
    def issue(self) -> Issue:
        return Issue(self.where, self.problem, self.value or None, self.fix or None)

    @property
    def where(self) -> str:
        return self.channel if self.time_s is None else f"{self.channel} at {self.time_s:g} s"

    def __str__(self) -> str:
        return f"{self.severity}: {self.issue}"

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "where": self.where}
