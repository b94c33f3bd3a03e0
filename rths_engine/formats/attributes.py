"""What the attributes beside an array say of it: step, start, unit, scale, offset, sensitivity, number of samples, duration.

value = scale * stored + offset        (CF conventions: `scale_factor`, `add_offset`)
value = stored / sensitivity           (where the unit of the sensitivity states both quantities: `100 mV/g`)

An `offset` without such a convention is not applied: whether it is added or subtracted, and in which unit, is not stated.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rths_engine.formats.statement import Statement, last_digit
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_KEYS = {
    "step": r"(?:dt|delta_?t|time_?step|sampl(?:e|ing)_?(?:interval|period|time)|ts)(?:_in)?(?:_(?P<unit>s|sec|ms|us))?",
    "rate": r"(?:fs|rate|sampl(?:e|ing)_?(?:freq|frequency|rate))(?:_in)?(?:_(?P<unit>hz|khz))?",
    "start": r"(?:t_?0|start|start_?time|time_?start|t_?start|start_?offset)(?:_in)?(?:_(?P<unit>s|sec|ms|us))?",
    "scale": r"scale|scale_?factor|scaling|scaling_?factor|calibration_?factor|cal_?factor|multiplier|slope",
    "gain": r"gain|gain_?factor",
    "calibration": r"cal(?:ibration)?|conv(?:ersion)?(?:_?factor)?",
    "add offset": r"add_?offset|intercept",
    "offset": r"offset",
    "sensitivity": r"sensitivity",
    "unit": r"units?|eng(?:ineering)?_?units?|eu|y_?units?|unit_?(?:name|label|string)",
    "sensitivity unit": r"(?:sensitivity|gain)_?units?|units?_?of_?(?:sensitivity|gain)",
    "count": r"npts|(?:n|num|number_?of)_?(?:samples|(?:data_?)?points|rows)|(?:sample|point|row)_?count|samples|data_?points",
    "perhaps count": r"n",
    "duration": r"duration|record_?length",
    "peak": r"peak(?:_?value)?|pga|abs_?max|max_?abs|absolute_?max(?:imum)?",
    "missing": r"missing(?:_?value)?|_?fill_?value|no_?data(?:_?value)?|(?:nan|null|na|bad|invalid|dummy)_?value",
}  # fmt: skip
_NAMED = {what: re.compile(pattern, re.IGNORECASE) for what, pattern in _KEYS.items()}
SCALING = ("scale", "gain", "calibration", "add offset", "offset", "sensitivity")
LEAST_COUNT = 32  # a smaller bare `n` can be a number of channels or of modes; chosen, see docs/decisions/0023
LONGEST_UNSTATED = 0.1  # s: a longer step without a unit can be in ms; chosen, see docs/decisions/0023
_UNIT_OF = re.compile(r"(?P<of>.+?)_?units?|units?_?of_?(?P<of_>.+)", re.IGNORECASE)
_SPELLED = {"sec": "s", "hz": "Hz", "khz": "kHz"}
_ZERO = re.compile(r"(?:zero|tare|bias)(?:_?(?:offset|value|level))?", re.IGNORECASE)
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*)?")


@dataclass(frozen=True, slots=True)
class Attributes:
    """The attributes of one object, by the words of `_KEYS`, each with the name and the value that the file writes."""

    found: Mapping[str, tuple[str, Any]]
    others: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)  # of the attribute whose name `dt_unit` contains

    @classmethod
    def of(cls, node: Mapping[str, Any]) -> Attributes:
        found: dict[str, tuple[str, Any]] = {}
        others = []
        units_of: dict[str, str] = {}
        for name, value in node.items():
            plain = _spelled(str(name))
            if isinstance(value, str) and (own := _UNIT_OF.fullmatch(plain)):
                units_of[(own["of"] or own["of_"]).lower()] = value.strip()
            what = next((what for what, pattern in _NAMED.items() if pattern.fullmatch(plain)), None)
            if what is not None and _plain(value):
                found.setdefault(what, (str(name), value))
            elif _ZERO.fullmatch(plain) and (zero := number(value)) is not None and zero:
                others.append(f"{name} = {zero:g} is not subtracted: state it as the offset of the column where it applies")
        return cls(found, tuple(others), units_of)

    @property
    def step(self) -> float | None:
        """Time step (s). Raises FileError where step and rate contradict each other."""
        dt, rate = self._in("step", "s"), self._in("rate", "Hz")
        if dt is not None and rate is not None and abs(dt * rate - 1) > 1e-3:
            problem = f"states a time step of {dt:.7g} s; {self.found['rate'][0]} states {rate:.7g} Hz, so {1 / rate:.7g} s"
            raise FileError(Issue(self.found["step"][0], problem, fix="the file contradicts itself: correct one of them"))
        return dt if dt is not None else 1 / rate if rate is not None else None

    @property
    def step_name(self) -> str:
        """The name of the attribute that states the step."""
        return next((self.found[what][0] for what in ("step", "rate") if what in self.found), "")

    @property
    def doubts(self) -> list[str]:
        """What is stated of the time, but not with a certain unit."""
        parts = [(what, unit, self._read(what, unit)) for what, unit in (("step", "s"), ("rate", "Hz"), ("start", "s"))]
        return [doubt for _, _, (value, doubt) in parts if value is None and doubt]

    @property
    def start(self) -> float | None:
        """Time of the first sample, s."""
        return self._in("start", "s", positive=False)

    @property
    def unit(self) -> str:
        value = self.found.get("unit", ("", ""))[1]
        return value if isinstance(value, str) else ""

    @property
    def scaling(self) -> list[str]:
        """The names of the attributes that change values: scale, gain, offset and the like."""
        return [self.found[what][0] for what in SCALING if what in self.found]

    @property
    def of_values(self) -> list[str]:
        """The names of the attributes that can be arrays beside the values: one number for each column, or several marks."""
        return [*self.scaling, *(self.found[what][0] for what in ("missing",) if what in self.found)]

    @property
    def missing(self) -> tuple[float, ...]:
        """The stored values that mark missing samples."""
        return tuple(map(float, self._numbers("missing"))) if "missing" in self.found else ()

    def scaled(self, values: Array, unit: str) -> tuple[Array, str, str, str]:
        """Values, unit, what was applied, and what was not applied and why. `values` has its columns along its second axis."""
        factors = [
            what
            for what in ("scale", "gain", "calibration")
            if what in self.found and not (np.all(self._numbers(what) == 1.0) and not self._unit_of(what))
        ]
        if len(factors) > 1:
            names = " and ".join(self.found[what][0] for what in factors)
            fix = "write the values in their unit, or state one factor"
            raise FileError(Issue(names, "both multiply the values; it is not clear which one applies", fix=fix))
        if "offset" in self.found and (zero := self._numbers("offset")).size and np.any(zero):
            return values, self._asked(unit), "", self._offset_unclear(unit)
        applied: list[str] = []
        refused = ""
        for what in factors:
            values, unit, refused = self._multiplied(what, values, unit, applied)
        if "add offset" in self.found and np.any(offset := self._numbers("add offset")):
            if refused or not _fits(offset, values):
                refused = refused or f"{self.found['add offset'][0]} is not applied: it has {offset.size} values"
            else:
                values = values + offset
                applied.append(f"+ {_text(offset)} ({self.found['add offset'][0]})")
        if "sensitivity" in self.found:
            values, unit, left = self._divided(values, unit, applied)
            refused = refused or left
        return values, unit, ("stored value " + " ".join(applied)) if applied else "", refused

    def statements(self, name: str, counts: Collection[int], dt: float | None) -> list[Statement]:
        """Number of samples and duration (s), where they are stated, beside the nearest of the lengths of the arrays."""
        found = []
        if (stated := self.count(counts, dt is not None)) is not None:
            what = "count" if "count" in self.found else "perhaps count"
            nearest = _nearest(stated, [*counts, sum(counts)])
            found.append(Statement(f"number of samples{name and f' of {name}'}", self.found[what][0], stated, nearest))
        if dt and (stated := self._in("duration", "s")) is not None:  # of the samples, or from the first to the last
            read = (_nearest(stated / dt + 0.5, counts) - 0.5) * dt
            found.append(Statement(f"duration{name and f' of {name}'}", self.found["duration"][0], stated, read, "s", dt))
        return found

    def count(self, counts: Collection[int], timed: bool) -> float | None:
        """The stated number of samples. A bare `n` is one where a step is stated and no length is twice or half as large."""
        sure, perhaps = self._in("count", "1"), self._in("perhaps count", "1")
        if sure is not None or perhaps is None or not timed or not counts:
            return sure
        return perhaps if 0.5 < perhaps / _nearest(perhaps, counts) < 2 and perhaps >= LEAST_COUNT else None

    def peak(self, name: str, values: Array, unit: str) -> list[Statement]:
        """The largest absolute value of the array, where it is stated."""
        if "peak" not in self.found or not np.isfinite(values).any():
            return []
        given = self._numbers("peak")
        ratio = _ratio(own, unit) if (own := self._unit_of("peak")) else 1.0
        if given.size != 1 or ratio is None or not given[0]:
            return []
        read = float(np.nanmax(np.abs(values)))
        within = last_digit(f"{given[0]:.7g}") / 2 * ratio + 1e-6 * read
        where = self.found["peak"][0]
        return [Statement(f"peak of {name}", where, abs(float(given[0])) * ratio, read, unit, within)]

    def _asked(self, unit: str) -> str:
        """The unit of values that are not scaled: a reading, whose gain is asked for; else none, so that it is asked for."""
        if _ratio(unit, "V") is not None or _ratio(unit, "V/V") is not None or _ratio(unit, "count") is not None:
            return unit
        scaled = any(what in self.found for what in ("scale", "gain", "calibration", "sensitivity"))
        return "count" if unit and scaled else ""

    def _offset_unclear(self, unit: str) -> str:
        names = ", ".join(f"{self.found[what][0]} = {_shown(self.found[what][1])}" for what in SCALING if what in self.found)
        why = "it is not stated whether the offset is added or subtracted, before or after a factor"
        return f"{names} not applied{unit and f' (unit {unit})'}: {why}; give the gain, offset and unit of the column"

    def _multiplied(self, what: str, values: Array, unit: str, applied: list[str]) -> tuple[Array, str, str]:
        name, _ = self.found[what]
        factor, given = self._numbers(what), self._unit_of(what)
        if not _fits(factor, values) or not np.isfinite(factor).all() or not np.all(factor):
            return values, unit, f"{name} is not applied: it has {factor.size} values, or is 0"
        shown = f"x {_text(factor)}{given and f' {given}'} ({name})"
        if not given and what == "calibration":
            return values, unit, f"{name} = {_text(factor)} is not applied: its unit, such as kN/V, is not stated"
        if unit and not given and what == "gain" and _ratio(unit, "V") is not None:
            return (
                values,
                unit,
                f"{name} = {_text(factor)} is not applied: the values are in {unit}, and its unit is not stated",
            )
        if given and "/" in given:
            over, _, under = given.partition("/")
            ratio = _ratio(unit, under)
            if unit and ratio is None and _ratio(unit, over) is None:
                return values, unit, f"{name} = {_text(factor)} {given} is not applied: the values are in {unit}"
            if ratio is not None:
                factor, unit = factor * ratio, over.strip()
            unit = unit or over.strip()
        applied.append(shown)
        return values * factor, unit, ""

    def _divided(self, values: Array, unit: str, applied: list[str]) -> tuple[Array, str, str]:
        name, _ = self.found["sensitivity"]
        factor, given = self._numbers("sensitivity"), self._unit_of("sensitivity")
        over, _, under = given.partition("/")
        ratio = _ratio(unit, over)
        if not under or ratio is None or not _fits(factor, values) or not np.all(factor):
            why = f"the values are in {unit or 'an unknown unit'}" if under else "its unit, such as mV/g, is not stated"
            return values, unit, f"{name} = {_text(factor)}{given and f' {given}'} is not applied: {why}"
        applied.append(f"/ ({_text(factor)} {given}) ({name})")
        return values * ratio / factor, under.strip(), ""

    def _unit_of(self, what: str) -> str:
        name, value = self.found[what]
        if isinstance(value, str) and (found := _QUANTITY.fullmatch(value)) and found[2]:
            return found[2].strip()
        stated = self.found.get("sensitivity unit", ("", ""))[1]
        if isinstance(stated, str) and stated and what in {"sensitivity", "gain"}:
            return stated
        return self.units.get(_spelled(name).lower(), "")

    def _numbers(self, what: str) -> Array:
        value = self.found[what][1]
        if isinstance(value, str):
            found = _QUANTITY.fullmatch(value)
            return np.array([float(found[1])]) if found else np.array([])
        return np.ravel(np.asarray(value, dtype=float))

    def _in(self, what: str, unit: str, positive: bool = True) -> float | None:
        """A number in `unit`; the name can state another one (`dt_ms`), a text (`4 ms`), and an attribute (`dt_unit`)."""
        result, _ = self._read(what, unit)
        return result if result is not None and (result > 0 or not positive) else None

    def _read(self, what: str, unit: str) -> tuple[float | None, str]:
        """The number in `unit`; else None, and why its unit is not certain."""
        if what not in self.found or (numbers := self._numbers(what)).size != 1 or not np.isfinite(numbers[0]):
            return None, ""
        name, value = self.found[what]
        match = _NAMED[what].fullmatch(_spelled(name))
        own = (match.groupdict().get("unit") if match else None) or ""
        stated = {_SPELLED.get(own.lower(), own.lower()), self._unit_of(what)} - {""}
        result, shown = float(numbers[0]), f"{name} = {_shown(value)}"
        ratios = {_ratio(one, unit) for one in stated}
        if len(ratios) > 1:
            return None, f"{shown} is not used: two units are stated, {' and '.join(sorted(stated))}"
        if None in ratios:
            return (None, f"{shown} is not used: {min(stated)} is not a unit of it") if unit != "1" else (None, "")
        if ratios:
            return result * (ratios.pop() or 1.0), ""
        step = 1 / result if what == "rate" and result > 0 else result if what == "step" else 0.0
        times = self.units.get("time", "") if what != "rate" else ""
        factor = _ratio(times, unit) if times else None
        if factor is not None and factor != 1.0 and what in {"step", "start"} and result:
            certain = what == "step" and step > LONGEST_UNSTATED
            return (result * factor, "") if certain else (None, f"{shown} is not used: it can be in {unit} or in {times}")
        if step > LONGEST_UNSTATED and factor is None:
            return None, f"{shown} is not used: it states no unit"
        return result, ""


def number(value: Any) -> float | None:
    """`value` as a finite number; None where it is an array, a text or a truth value."""
    found = np.asarray(value) if isinstance(value, int | float | np.ndarray | np.generic) else None
    if found is None or isinstance(value, bool) or found.size != 1 or found.dtype.kind not in "fiu":
        return None
    result = float(found.reshape(-1)[0])
    return result if np.isfinite(result) and abs(result) < 1e12 else None


def _spelled(name: str) -> str:
    """The name in words with `_` between them: `sampling rate`, `sampling-rate` and `samplingRate` as `sampling_rate`."""
    found = re.sub(r"[ \-.]+", "_", name.strip())
    return found if "_" in found else re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", found)


def _plain(value: Any) -> bool:
    """Whether the value can be an attribute: a text, a number, or a number for each column."""
    if isinstance(value, str) or number(value) is not None:
        return True
    listed = isinstance(value, list | np.ndarray) and 0 < np.size(value) <= 1000
    return listed and all(number(one) is not None for one in np.ravel(np.asarray(value, dtype=object)))


def _nearest(value: float, counts: Iterable[int]) -> int:
    return min(counts, key=lambda one: abs(one - value))


def _shown(value: Any) -> str:
    return value.strip() if isinstance(value, str) else _text(np.ravel(np.asarray(value, dtype=float)))


def _fits(factor: Array, values: Array) -> bool:
    return factor.size == 1 or (values.ndim == 2 and factor.size == values.shape[1])


def _ratio(given: str, wanted: str) -> float | None:
    """How many `wanted` one `given` is; None where their dimensions differ. Equal words are one unit: counts, count."""
    one, other = unit_names.read(given), unit_names.read(wanted)
    if not one.unit and given.strip() and given.strip().lower().rstrip("s") == wanted.strip().lower().rstrip("s"):
        return 1.0
    if not one.unit or not other.unit or one.dimension != other.dimension:
        return None
    return one.scale * units.factor(one.unit) / (other.scale * units.factor(other.unit))


def _text(values: Array) -> str:
    return ", ".join(f"{one:.9g}" for one in values[:4]) + (", ..." if values.size > 4 else "")
