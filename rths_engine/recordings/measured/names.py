"""Role, number and unit from the name of a column, as laboratories write them."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field

from rths_engine.foundation import unit_names
from rths_engine.foundation.unit_names import Written
from rths_engine.recordings.measured import words
from rths_engine.recordings.measured.roles import RAW, ROLES

_BRACKETS = re.compile(r"\(((?:[^()]|\([^()]*\))*)\)|\[([^\[\]]*)\]|\{([^{}]*)\}")
_LONGEST_UNIT = 12  # characters of a bracket that is reported as an unknown unit; chosen, see docs/decisions/0023
_NO_UNIT = re.compile(r"[\d\s.,:;#-]+|column \d+")  # a number in brackets; the column number added to equal names
_NO_TAIL = re.compile(r"[-%\d]+|[cCFfkvaMThSJKn]", re.IGNORECASE)  # ends of names that are more often a letter of a channel
_IS_TAIL = {"s", "m", "g", "N", "V", "A"}
_WITH_UNIT = re.compile(r"(?<![\w.])(?:@\s*)?(\d+(?:\.\d+)?)\s*([A-Za-z%\u00b5\u03bc/][A-Za-z/]*)(?![A-Za-z0-9])")
_OF_RANGES = {"N", "V", "%", "m", "A"}  # units of one letter that stand behind a range
MOST_COUNTED = 9  # sensors of one kind that are numbered with one digit; chosen, see docs/decisions/0023
_NONE = Written("")


@dataclass(frozen=True, slots=True)
class Named:
    """What a name states: role, number and unit; empty or None where it does not state them.

    `written` is the unit as the file writes it, known or not. `by_name`: words of the name mean the role. `aside`: why the
    column is not a measurement.
    """

    role: str = ""
    number: int | None = None
    unit: str = ""
    written: Written = field(default=_NONE, compare=False)
    by_name: bool = field(default=False, compare=False)
    aside: str = field(default="", compare=False)

    @property
    def scale(self) -> float:
        """One unit of the column in `unit`: 0.05 for a column in `0.05 g`."""
        return self.written.scale


def read(name: str, unit: str = "", quantity: str = "") -> Named:
    """Role, number and unit of the column `name`.

    `unit` is its unit where the file states it separately, `quantity` the dimension where the format states it.
    """
    written, rest, certain = stated_unit(name, unit)
    rest = without_ranges(rest, written)
    spoken, number = bare(rest)
    roles = [role for role, pattern in words.ROLES if pattern.search(spoken)]
    if not certain and written.unit and not _fits(written.dimension, roles):
        written, rest = _NONE, name
        spoken, number = bare(rest)
        roles = [role for role, pattern in words.ROLES if pattern.search(spoken)]
    kind = written.dimension or quantity
    if words.OF_RECORDER.search(spoken):
        return Named(written=written, aside="is of the recorder by its name: what it measures is not stated")
    if kind == "length" and roles[:1] == ["drive"] and not words.IS_DRIVE.search(spoken):
        roles = ["x_meas"]  # u is a displacement where its unit is one
    fitting = [role for role in roles if not kind or kind in ROLES[role].dimensions or (kind in RAW and role != "t")]
    if kind == "force" and roles and roles[0] in ("x_cmd", "x_comp"):
        return Named(written=written, aside="is the command of a force by its name: no role is a commanded force")
    if not kind and (aside := _aside(spoken)):
        return Named(written=written, aside="; ".join(part for part in (aside, written.problem) if part))
    role = fitting[0] if fitting else _by_dimension(kind, roles)
    if not role and kind == "mass":
        role = next((one for one in roles if "force" in ROLES[one].dimensions), "")
    aside = "" if role or not kind else _without_role(written.unit, kind)
    return Named(role, number if role and ROLES[role].counts else None, _usable(written, role), written, bool(fitting), aside)


def stated_unit(name: str, unit: str = "") -> tuple[Written, str, bool]:
    """The unit of a column, its name without the unit, and whether the text is certainly a unit.

    The unit stands separately in the file, in brackets (`Force (kN)`), or at the end of the name (`force_kN`, `Disp, mm`,
    `v mm/s`). A unit in brackets that is not known is returned with its problem.
    """
    name = words.AZIMUTH.sub(" ", name)
    own = unit_names.read(unit)
    unknown = _NONE
    for match in _BRACKETS.finditer(name):
        inside = next(text for text in match.groups() if text is not None)
        found = unit_names.read(inside)
        if found.unit and not _NO_UNIT.fullmatch(inside):
            rest = name[: match.start()] + " " + name[match.end() :]
            return (found if own.none else own), rest, True
        if unknown.none and found.problem and len(inside) <= _LONGEST_UNIT and not _NO_UNIT.fullmatch(inside):
            unknown = found
    if not own.none:
        return own, name, True
    parts = re.split(r"[,_\s]+", name.strip())
    for count in (3, 2, 1):
        if len(parts) > count and (tail := _tail(parts[-count:])).unit:
            return tail, " ".join(parts[:-count]), False
    return unknown, name, True


def without_ranges(name: str, written: Written) -> str:
    """The name without the numbers that have a unit behind them: `Load cell 500 kN`, `filtered 10 Hz`, `@ 250 Hz`.

    `acc 2 g` in g is the second accelerometer: a digit before the unit of the column itself stays.
    """

    def kept(found: re.Match[str]) -> str:
        unit = unit_names.read(found[2])
        if "." in found[1] or ("/" in found[2] and not unit.unit and all(map(unit_names.known, found[2].split("/")))):
            return " "  # `2.5 kN/V`
        letter = len(found[2]) == 1 and found[2] not in _OF_RANGES
        own = unit.unit and unit.dimension == written.dimension and float(found[1]) <= MOST_COUNTED
        return found[0] if not unit.unit or letter or own else " "

    return _WITH_UNIT.sub(kept, name)


def bare(name: str) -> tuple[str, int | None]:
    """The name in lower-case words without accents, and its station or floor: `s2.x_cmd`, `Disp 2`, `floor1.x`, `x_meas.1`."""
    plain = unicodedata.normalize("NFKD", name.replace("ß", "ss"))
    plain = "".join(sign for sign in plain if not unicodedata.combining(sign))
    spaced = re.sub(r"([a-z])([A-Z])", r"\1 \2", _BRACKETS.sub(" ", plain))
    spaced = re.sub(r"[^0-9A-Za-z]+", " ", spaced).strip()
    product = re.fullmatch(r"s(\d{1,3}) (.+)", spaced)
    if product:
        return product[2].lower(), int(product[1])
    apart = re.sub(r"(?<=[A-Za-z])(?=\d)", " ", spaced)
    numbers = re.findall(r"\b\d{1,3}\b", apart)
    number = int(numbers[-1]) if numbers and 0 < int(numbers[-1]) < 1000 else None
    return re.sub(r"\s+", " ", re.sub(r"\b\d+\b", " ", apart)).strip().lower(), number


def _fits(kind: str, roles: list[str]) -> bool:
    """Whether the end of a name can be a unit of this dimension, beside the roles that the other words mean."""
    if not roles:
        return kind in words.BY_DIMENSION or kind == "voltage"
    return kind in RAW or any(kind in ROLES[role].dimensions for role in roles)


def _by_dimension(kind: str, roles: list[str]) -> str:
    on_floor = "x_floor" in roles or "v_floor" in roles
    of_floor = {"length": "x_floor", "velocity": "v_floor"} if on_floor else {}
    return of_floor.get(kind) or words.BY_DIMENSION.get(kind, "")


def _usable(written: Written, role: str) -> str:
    """The unit where the role takes it, with a gain if need be; empty for a mass, which is not a force."""
    kind = written.dimension
    return written.unit if role and (kind in ROLES[role].dimensions or kind in RAW) else ""


def _without_role(unit: str, kind: str) -> str:
    if kind in RAW:
        return f"is in {unit}, and its name does not say what it measures: give it a role and a gain"
    return f"is in {unit}, a unit of {kind}, which is the quantity of no role"


def _aside(spoken: str) -> str:
    return next((why for pattern, why in words.ASIDE if pattern.search(spoken)), "")


def _tail(parts: list[str]) -> Written:
    """The unit at the end of a name: `[mm, s]` is mm/s, `[m, s2]` m/s^2. Letters that are also parts of names count by case."""
    if len(parts) == 1:
        return _NONE if parts[0] not in _IS_TAIL and _NO_TAIL.fullmatch(parts[0]) else unit_names.read(parts[0])
    if parts[-1].lower() in {"s2", "s^2"} or (len(parts) == 3 and parts[1:] == ["s", "2"]):
        return unit_names.read(f"{parts[0]}/s^2")
    return unit_names.read(f"{parts[0]}/s") if len(parts) == 2 and parts[-1].lower() in {"s", "sec"} else _NONE
