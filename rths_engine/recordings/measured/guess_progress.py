"""The state of a guess: which columns are taken for which role, and which are left out."""

from __future__ import annotations

from dataclasses import dataclass, field

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.unit_names import Written
from rths_engine.recordings.measured.names import Named

# chosen; see docs/decisions/0023
MARK = "a guess"  # begins the reason of a role that neither a unit nor a format confirms


@dataclass
class Taken:
    """The role of a column, why, and what the file states about its unit."""

    role: str
    number: int | None
    why: str
    unit: str = ""
    scale: float = 1.0
    written: Written = field(default_factory=lambda: Written(""))


@dataclass
class Progress:
    """The columns taken and left so far. `seconds`: the step where the file states its unit; `step`: in the file's own unit."""

    table: Table
    said: dict[str, Named] = field(default_factory=dict)
    taken: dict[str, Taken] = field(default_factory=dict)
    left: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    step: float = 0.0
    seconds: float = 0.0

    def unclear(self) -> list[Column]:
        """The columns that are neither taken nor left out."""
        return [one for one in self.table.columns if one.name not in self.taken and one.name not in self.left]

    def of(self, role: str) -> list[str]:
        """The names of the columns taken for a role, in the order of the file."""
        used = [one.name for one in self.table.columns if one.name in self.taken and one.name not in self.left]
        return [name for name in used if self.taken[name].role == role]

    def take(self, name: str, role: str, why: str) -> None:
        """Take a column for a role with the unit that the file states for it."""
        said = self.said[name]
        unit = said.unit if said.role == role else ""
        self.taken[name] = Taken(role, said.number, why, unit, said.scale if unit else 1.0, said.written)
