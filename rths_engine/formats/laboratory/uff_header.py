"""The eleven lines of the header of a dataset 58, in their fixed columns."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rths_engine.formats.table import Column
from rths_engine.foundation.errors import FileError, Issue

# by definition: specific data types, and directions
_QUANTITIES = {8: "displacement", 9: "force", 11: "velocity", 12: "acceleration", 13: "force"}
_DIRECTIONS = {1: "X", 2: "Y", 3: "Z", 4: "RX", 5: "RY", 6: "RZ"}
_STEPS = {"s": 1.0, "sec": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3}


@dataclass(frozen=True)
class Header:
    """What a dataset states. `order` and `floats` are those of binary data; `step` and `start` in the unit of the abscissa."""

    where: str
    text: str
    name: str
    function: int
    double: bool
    is_complex: bool
    count: int
    even: bool
    start: float
    step: float
    abscissa_unit: str
    quantity: str
    unit: str
    binary: bool
    order: str
    floats: int

    @classmethod
    def of(cls, lines: list[str], where: str) -> Header:
        """The header in twelve lines. Raises FileError where a field is not a number."""
        if len(lines) < 12:
            raise FileError(Issue(where, "has an incomplete header", fix="get the file again"))
        try:
            return cls._of(lines, where)
        except ValueError as error:
            raise FileError(Issue(where, f"has a header outside the definition: {error}", fix="export it again")) from None

    @classmethod
    def _of(cls, lines: list[str], where: str) -> Header:
        first, point, form, across, along = lines[0], lines[6], lines[7], lines[8], lines[9]
        binary = first[6:7].lower() == "b"
        kind = int(form[:10])
        if kind not in (2, 4, 5, 6):
            raise ValueError(f"ordinate data type {kind}")
        quantity = int(along[:10])
        return cls(
            where,
            "\n".join(lines),
            _name(lines[1], point, _text(along[25:46])),
            int(point[:5]),
            kind in (4, 6),
            kind in (5, 6),
            int(form[10:20]),
            int(form[20:30]) == 1,
            _real(form[30:43]),
            _real(form[43:56]),
            _text(across[46:67]),
            _QUANTITIES.get(quantity, ""),
            _text(along[46:67]),
            binary,
            ("<" if int(first[7:13]) == 1 else ">") if binary else "",
            int(first[13:19]) if binary else 0,
        )

    @property
    def seconds(self) -> float:
        """Seconds in the unit of the abscissa; 0 where it is not a time or its unit is not stated."""
        return _STEPS.get(self.abscissa_unit.lower(), 0.0)

    def timed(self, column: Column) -> Column:
        """The column with step and start, where they are times."""
        if not self.seconds or self.step <= 0:
            return column
        return replace(column, dt=self.step * self.seconds, start=self.start * self.seconds)


def _real(text: str) -> float:
    return float(text.replace("D", "E").replace("d", "e")) if text.strip() else 0.0


def _text(field: str) -> str:
    found = field.strip()
    return "" if found.upper() == "NONE" else found


def _name(title: str, point: str, label: str) -> str:
    """Name of the point with its direction, and the label of the ordinate: `1+Z Acceleration`."""
    entity, node, direction = _text(point[31:41]), int(point[41:51]), int(point[51:55])
    axis = f"{'-' if direction < 0 else '+'}{_DIRECTIONS[abs(direction)]}" if abs(direction) in _DIRECTIONS else ""
    place = entity or (f"{node}{axis}" if node or axis else "")
    return " ".join(part for part in (place, label or _text(title)[:40]) if part) or "record"
