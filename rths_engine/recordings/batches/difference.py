"""A difference between a file of a batch and the other files."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from rths_engine.foundation.errors import Issue

Severity = Literal["error", "warning", "note"]
SEVERITIES: tuple[Severity, ...] = ("error", "warning", "note")
NOTHING = "none"  # the value of what a file does not have or state


@dataclass(frozen=True, slots=True)
class Difference:
    """What differs (`unit`), of which column, channel or entry of the header, here and in the other files.

    An error would change the meaning of the numbers and refuses the file. A warning needs a person's eye. A note is a fact.
    """

    severity: Severity
    what: str
    of: str
    here: str
    others: str

    @property
    def text(self) -> str:
        """The difference as a sentence without its stop."""
        return f"{self.what}{self.of and f' of {self.of}'}: {self.here}; in the other files {self.others}"

    @property
    def issue(self) -> Issue:
        fix = "import this file alone, after checking its mapping"
        return Issue(self.of, f"differs from the other files in its {self.what}, {self.others} there", self.here, fix)

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "text": self.text}
