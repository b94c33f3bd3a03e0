"""What the attributes beside an array say of it: step, start, unit, scale, offset, sensitivity, number of samples, duration.

value = scale * stored + offset        (CF conventions: `scale_factor`, `add_offset`)
value = stored / sensitivity           (where the unit of the sensitivity states both quantities: `100 mV/g`)
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.formats.statement import Statement
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_KEYS = {
    "step": r"(?:dt|delta_?t|time_?step|sampl(?:e|ing)_?(?:interval|period|time)|ts)(?:_in)?(?:_(?P<unit>s|sec|ms|us))?",
    "rate": r"(?:fs|rate|sampl(?:e|ing)_?(?:freq|frequency|rate))(?:_in)?(?:_(?P<unit>hz|khz))?",
    "start": r"(?:t_?0|start|start_?time|time_?start|t_?start|start_?offset)(?:_in)?(?:_(?P<unit>s|sec|ms|us))?",
    "scale": r"scale|scale_?factor|scaling|scaling_?factor|calibration_?factor|cal_?factor|multiplier|slope",
    "gain": r"gain|gain_?factor",
    "offset": r"offset|add_?offset|intercept",
    "sensitivity": r"sensitivity",
    "unit": r"units?|engineering_?units?|eu|y_?units?|unit_?(?:name|label|string)",
    "sensitivity unit": r"(?:sensitivity|gain)_?units?|units?_?of_?(?:sensitivity|gain)",
    "count": r"npts|(?:n|num|number_?of)_?samples|sample_?count|samples",
    "duration": r"duration|record_?length",
}  # fmt: skip
_NAMED = {what: re.compile(pattern, re.IGNORECASE) for what, pattern in _KEYS.items()}
_SPELLED = {"sec": "s", "hz": "Hz", "khz": "kHz"}
_ZERO = re.compile(r"(?:zero|tare|bias)(?:_?(?:offset|value|level))?", re.IGNORECASE)
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*)?")


@dataclass(frozen=True, slots=True)
class Attributes:
    """The attributes of one object, by the words of `_KEYS`, each with the name and the value that the file writes."""

    found: Mapping[str, tuple[str, Any]]
    others: tuple[str, ...] = ()

    @classmethod
    def of(cls, node: Mapping[str, Any]) -> Attributes:
        found: dict[str, tuple[str, Any]] = {}
        others = []
        for name, value in node.items():
            plain = _spelled(str(name))
            what = next((what for what, pattern in _NAMED.items() if pattern.fullmatch(plain)), None)
            if what is not None and _plain(value):
                found.setdefault(what, (str(name), value))
            elif _ZERO.fullmatch(plain) and (zero := number(value)) is not None and zero:
                others.append(f"{name} = {zero:g} is not subtracted: state it as the offset of the column where it applies")
        return cls(found, tuple(others))

    @property
    def step(self) -> float | None:
        """Time step (s). Raises FileError where step and rate contradict each other."""
        dt, rate = self._in("step", "s"), self._in("rate", "Hz")
        if dt is not None and rate is not None and abs(dt * rate - 1) > 1e-3:
            problem = f"states a time step of {dt:.7g} s; {self.found['rate'][0]} states {rate:.7g} Hz, so {1 / rate:.7g} s"
            raise FileError(Issue(self.found["step"][0], problem, fix="the file contradicts itself: correct one of them"))
        return dt if dt is not None else 1 / rate if rate is not None else None

    @property
    def start(self) -> float | None:
        """Time of the first sample, s."""
        return self._in("start", "s", positive=False)

    @property
    def unit(self) -> str:
        value = self.found.get("unit", ("", ""))[1]
        return value if isinstance(value, str) else ""

    @property
    def scales(self) -> bool:
        """Whether scale, gain, offset or sensitivity is stated."""
        return not {"scale", "gain", "offset", "sensitivity"}.isdisjoint(self.found)

    def scaled(self, values: Array, unit: str) -> tuple[Array, str, str, str]:
        """Values, unit, what was applied, and what was not applied and why. `values` has its columns along its second axis."""
        factors = [what for what in ("scale", "gain") if what in self.found and not np.all(self._numbers(what) == 1.0)]
        if len(factors) > 1:
            names = " and ".join(self.found[what][0] for what in factors)
            fix = "write the values in their unit, or state one factor"
            raise FileError(Issue(names, "both multiply the values; it is not clear which one applies", fix=fix))
        applied: list[str] = []
        refused = ""
        for what in factors:
            values, unit, refused = self._multiplied(what, values, unit, applied)
        if "offset" in self.found and np.any(offset := self._numbers("offset")):
            if refused or not _fits(offset, values):
                refused = refused or f"{self.found['offset'][0]} is not applied: it has {offset.size} values"
            else:
                values = values + offset
                applied.append(f"+ {_text(offset)} ({self.found['offset'][0]})")
        if "sensitivity" in self.found:
            values, unit, left = self._divided(values, unit, applied)
            refused = refused or left
        return values, unit, ("stored value " + " ".join(applied)) if applied else "", refused

    def statements(self, name: str, count: int, dt: float | None) -> list[Statement]:
        """Number of samples and duration (s), where they are stated."""
        found = []
        if (stated := self._in("count", "1")) is not None:
            found.append(Statement(f"number of samples of {name}", self.found["count"][0], stated, count))
        if dt and (stated := self._in("duration", "s")) is not None:  # of the samples, or from the first to the last
            found.append(Statement(f"duration of {name}", self.found["duration"][0], stated, (count - 0.5) * dt, "s", dt))
        return found

    def _multiplied(self, what: str, values: Array, unit: str, applied: list[str]) -> tuple[Array, str, str]:
        name, _ = self.found[what]
        factor, given = self._numbers(what), self._unit_of(what)
        if not _fits(factor, values) or not np.isfinite(factor).all() or not np.all(factor):
            return values, unit, f"{name} is not applied: it has {factor.size} values, or is 0"
        shown = f"x {_text(factor)}{given and f' {given}'} ({name})"
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
        value = self.found[what][1]
        if isinstance(value, str) and (found := _QUANTITY.fullmatch(value)):
            return (found[2] or "").strip()
        stated = self.found.get("sensitivity unit", ("", ""))[1]
        return stated if isinstance(stated, str) and what in {"sensitivity", "gain"} else ""

    def _numbers(self, what: str) -> Array:
        value = self.found[what][1]
        if isinstance(value, str):
            found = _QUANTITY.fullmatch(value)
            return np.array([float(found[1])]) if found else np.array([])
        return np.ravel(np.asarray(value, dtype=float))

    def _in(self, what: str, unit: str, positive: bool = True) -> float | None:
        """A number in `unit`; the name can state another one (`dt_ms`), and so can a text (`4 ms`)."""
        if what not in self.found:
            return None
        name, value = self.found[what]
        if isinstance(value, str):
            found = _QUANTITY.fullmatch(value)
            if found is None or not found[2] or _ratio(found[2], unit) is None:
                return None
            result: float | None = float(found[1]) * (_ratio(found[2], unit) or 1.0)
        else:
            result = number(value)
            match = _NAMED[what].fullmatch(_spelled(name))
            own = (match.groupdict().get("unit") if match else None) or ""
            ratio = _ratio(_SPELLED.get(own.lower(), own.lower()), unit) if own else 1.0
            result = result if result is None else result * (ratio or 1.0)
        return result if result is not None and (result > 0 or not positive) else None


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
