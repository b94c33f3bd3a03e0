"""Role, number and unit from the name of a column, as laboratories write them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from rths_engine.foundation import unit_names
from rths_engine.recordings.measured.roles import ROLES, UNITS, dimension

_FLOOR = "(floor|storey|story|level|roof|mass|dof)"

# role -> pattern of its column names; the first match counts
_ROLES: tuple[tuple[str, str], ...] = (
    ("t", r"^(t|time|times|timestamp|elapsed|zeit|temps|tiempo|sec|seconds|clock)$|^(time|elapsed)\b|\btime$"),
    ("temperature", r"\btemp(erature)?s?\b|\btherm|\btc\b"),
    ("ag", r"\bag\b|\b(ground|base|table|input|shake)\b.*\bacc|\bacc\w*\b.*\b(ground|base|table|input)\b|\beq acc"),
    ("a_floor", r"\ba floor\b|\bacc?\w*"),
    ("force_ext", r"\bforce ext\b|\b(external|ext|applied|hammer|exciter|shaker)\b.*\b(force|load)|\bhammer\b"),
    ("x_comp", r"\bx comp\b|\bcompensated\b|\bcomp\b"),
    ("x_cmd", r"\bx cmd\b|\bx ?c\b|\b(cmd|command\w*|target|ref|reference|setpoint|set point|desired|qg|demand)\b"),
    ("f_meas", r"\bf meas\b|\b(force|load|kraft|restoring|lc|loadcell|fmeas|f)\b"),
    ("v_floor", rf"\bv floor\b|\b{_FLOOR}\b.*\bvel\w*|\bvel\w*\b.*\b{_FLOOR}\b"),
    ("v_meas", r"\bv meas\b|\bvel\w*|\bspeed\b|\b(v|xdot|dx|qdot)\b"),
    ("current", r"\bcurrent\w*|\bcurr\b|\bamp(s|ere\w*)?\b|\bi\b"),
    ("drive", r"\bdrive\b|\bcontrol\w*|\bexcit\w*|\bvalve\b|\bservo\b|\binput\b|\bvoltage\b|\bu\b|\bvir\b"),
    ("x_floor", rf"\bx floor\b|\b{_FLOOR}\b"),
    ("x_meas", r"\bx meas\b|\b(disp\w*|position|pos|stroke|lvdt|travel|extension|weg|actuator|qm|x|d|y|q)\b"),
)  # fmt: skip
_WORDS = tuple((role, re.compile(pattern)) for role, pattern in _ROLES)
_BY_UNIT = {
    "time": "t",
    "length": "x_meas",
    "velocity": "v_meas",
    "acceleration": "a_floor",
    "force": "f_meas",
    "current": "current",
    "temperature": "temperature",
    "voltage": "drive",
}


@dataclass(frozen=True, slots=True)
class Named:
    """Role, number and unit in a name; empty or None where the name does not state them."""

    role: str = ""
    number: int | None = None
    unit: str = ""


def written_unit(text: str) -> str:
    """The unit of a measurement that the text names; empty where it names no such unit."""
    found = unit_names.written_unit(text)
    return found if found in UNITS else ""


def read(name: str, unit: str = "") -> Named:
    """Role, number and unit of the column `name`; `unit` is its unit where the file states it separately."""
    found, rest = _split_unit(name)
    unit = written_unit(unit) or found
    words, number = _words(rest if unit else name)
    roles = [role for role, pattern in _WORDS if pattern.search(words)]
    if unit:
        kind = dimension(unit)
        fitting = [role for role in roles if kind in ROLES[role].dimensions]
        of_other = [
            role for role in roles if kind == "voltage" and role != "t"
        ]  # a quantity measured in volts: its gain is missing
        if fitting or of_other:
            role = (fitting or of_other)[0]
        else:
            on_floor = "x_floor" in roles or "v_floor" in roles
            by_unit = {"length": "x_floor", "velocity": "v_floor"} if on_floor else {}
            role = by_unit.get(kind) or _BY_UNIT.get(kind, "")
    else:
        role = roles[0] if roles else ""
    return Named(role, number if role and ROLES[role].counts else None, unit)


def _split_unit(name: str) -> tuple[str, str]:
    """The unit in a name, `Force (kN)`, `force_kN`, `Disp, mm`, `v mm/s`, and the name without it."""
    for match in re.finditer(r"[(\[{]([^()\[\]{}]*)[)\]}]", name):
        if unit := written_unit(match[1]):
            return unit, name[: match.start()] + " " + name[match.end() :]
    parts = re.split(r"[,_\s]+", name.strip())
    for count in (3, 2, 1):
        if len(parts) > count and (unit := _tail(parts[-count:])):
            return unit, " ".join(parts[:-count])
    return "", name


def _tail(parts: list[str]) -> str:
    """The unit at the end of a name: `[mm, s]` is mm/s, `[m, s2]` m/s^2. Letters that are also parts of names count by case."""
    if len(parts) == 1:
        return "" if parts[0] in {"c", "C", "F", "f", "k", "v", "a", "-", "1", "%", "M", "T"} else written_unit(parts[0])
    if parts[-1].lower() in {"s2", "s^2"} or (len(parts) == 3 and parts[1:] == ["s", "2"]):
        return written_unit(f"{parts[0]}/s^2")
    return written_unit(f"{parts[0]}/s") if len(parts) == 2 and parts[-1].lower() in {"s", "sec"} else ""


def _words(name: str) -> tuple[str, int | None]:
    """The name in lower-case words, and its station or floor: `s2.x_cmd`, `Disp 2`, `floor1.x`, `x_meas.1`."""
    spaced = re.sub(r"([a-z])([A-Z])", r"\1 \2", re.sub(r"[(\[{].*?[)\]}]", " ", name))
    spaced = re.sub(r"[^0-9A-Za-z]+", " ", spaced).strip()
    product = re.fullmatch(r"s(\d{1,3}) (.+)", spaced)
    if product:
        return product[2].lower(), int(product[1])
    apart = re.sub(r"(?<=[A-Za-z])(?=\d)", " ", spaced)
    numbers = re.findall(r"\b\d{1,3}\b", apart)
    number = int(numbers[-1]) if numbers and 0 < int(numbers[-1]) < 1000 else None
    return re.sub(r"\s+", " ", re.sub(r"\b\d+\b", " ", apart)).strip().lower(), number
