"""The mapping of a file's columns to channels: value = sign * gain * (column - offset), with unit, role, station or floor.

A mapping is a frozen value like a plan, in YAML with `schema: rths-mapping/1`. It is stored with the recording and can be used
for the next file of the same instrument.
"""

from __future__ import annotations

import math
import re
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, field_validator, model_validator

from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import Issue, MeasuredError, PlanError
from rths_engine.foundation.part import Value, quantity, validated
from rths_engine.planning import plan_yaml
from rths_engine.recordings.measured.roles import RAW, ROLES, UNITS, dimension, key, units_of

# chosen; see docs/decisions/0023
SCHEMA: Literal["rths-mapping/1"] = "rths-mapping/1"
MOST_CHANNELS = 200
LARGEST_NUMBER = 999  # of a station or floor
_RAW_UNITS = tuple(unit for unit in UNITS if dimension(unit) in RAW)
_GAIN = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")

RoleName = Literal[
    "t", "ag", "drive", "x_cmd", "x_comp", "x_meas", "v_meas", "f_meas", "current", "coil_voltage",
    "temperature",    "x_floor", "v_floor", "a_floor", "force_ext",
]  # fmt: skip


def _gain(value: Any) -> Any:
    return f"{value!r}" if isinstance(value, int | float) and not isinstance(value, bool) else value


class ColumnMap(Value):
    """The mapping of one column, given by its name or its number from 1, to a channel.

    A proposal leaves `unit` empty where the file states none, and `gain` where the unit is that of a reading (V, count):
    `lacks` says so, and the import refuses it.
    """

    column: Annotated[str, Field(max_length=300)] | int = Field(title="Column")
    role: RoleName = Field(title="Role")
    number: int | None = Field(None, ge=1, le=LARGEST_NUMBER, title="Station or floor")
    unit: str = Field(title="Unit of the column", max_length=40, description="empty: not chosen yet")
    gain: Annotated[str | None, BeforeValidator(_gain)] = Field(
        None, title="Gain", max_length=60, description="a factor, or with units: 35.15 N/V"
    )
    offset: float = Field(0.0, title="Offset", description="the column's reading at zero, in its own unit")
    reverse: bool = Field(False, title="Reversed sign")
    label: str = Field("", title="Label", max_length=120)
    time: str | None = Field(
        None, max_length=300, title="Own time column", description="where channels were sampled by different clocks"
    )
    rate: float | None = quantity("Own rate", "Hz", default=None, gt=0)
    lag: float = quantity("Lag of its clock", "s", "ms", default=0.0, help="subtracted from the times of the column")

    @field_validator("unit")
    @classmethod
    def _known(cls, unit: str) -> str:
        return _unit(unit) if unit.strip() else ""

    @model_validator(mode="after")
    def _fits(self) -> ColumnMap:
        role, counts = ROLES[self.role], ROLES[self.role].counts
        if self.number is not None and not counts:
            raise ValueError(f"{self.role} takes no number: a recording has only one {self.role}")
        factor, result = self.scale if self.unit else (1.0, "")
        if factor == 0 or not math.isfinite(factor):
            raise ValueError(f"gain {self.gain} needs a finite factor other than 0")
        if result and not self.lacks and dimension(result) not in role.dimensions:
            raise ValueError(f"needs a unit of {' or '.join(role.dimensions)} as {self.role}, not {result}")
        if self.time is not None and self.rate is not None:
            raise ValueError("has both a time column and a rate; give only one of them")
        return self

    @property
    def scale(self) -> tuple[float, str]:
        """Factor of the gain and the resulting unit. Raises ValueError for a gain that is not valid."""
        if self.gain is None:
            return 1.0, self.unit
        found = _GAIN.fullmatch(self.gain)
        if not found:
            raise ValueError(f"gain {self.gain!r} needs a factor, optionally with units, such as '35.15 N/V'")
        if not found[2]:
            return float(found[1]), self.unit
        for result, own in _quotients(found[2]):
            if own == self.unit:
                return float(found[1]), result
        raise ValueError(
            f"gain {self.gain!r} needs units such as '35.15 N/{_divisor(self.unit)}', because the column is in {self.unit}"
        )

    @property
    def lacks(self) -> Issue | None:
        """What is missing before the column can be imported: its unit, or the gain of a reading in V, mV, mV/V or counts."""
        role = ROLES[self.role]
        if not self.unit:
            reading = f"; a reading in {', '.join(_RAW_UNITS)} needs a gain too" if self.role != "t" else ""
            fix = f"choose one of {', '.join(units_of(self.role))}{reading}"
            return Issue("unit", f"the unit of column '{self.column}' is not stated: choose the unit", fix=fix)
        kind = dimension(self.unit)
        if self.gain is None and kind in RAW and kind not in role.dimensions:
            problem = f"column '{self.column}' needs a unit of {' or '.join(role.dimensions)} as {self.role}, not {self.unit}"
            return Issue("gain", problem, fix=f"give a gain such as '2.5 {_example(role.dimensions[0])}/{_divisor(self.unit)}'")
        return None

    @property
    def key(self) -> str:
        return key(self.role, self.number or 1)


class Mapping(Value):
    """The mapping of a file: its columns of measurements and their time."""

    schema_: Literal["rths-mapping/1"] = Field(SCHEMA, alias="schema")
    title: str = Field("", max_length=200)
    test: Literal["hybrid", "specimen", "actuator", "structure"] | None = Field(None, title="Kind of test")
    dt: float | None = quantity("Step where no column is time", "s", default=None, gt=0)
    rate: float | None = quantity("Rate where no column is time", "Hz", default=None, gt=0)
    start: float | None = quantity("Start, in the file's time", "s", default=None)
    stop: float | None = quantity("Stop, in the file's time", "s", default=None)
    target_rate: float | None = quantity("Rate of the recording", "Hz", default=None, gt=0, le=1e6)
    channels: tuple[ColumnMap, ...] = Field(min_length=1, max_length=MOST_CHANNELS)

    @model_validator(mode="after")
    def _consistent(self) -> Mapping:
        keys = [channel.key for channel in self.channels if channel.role != "t"]
        twice = sorted({one for one in keys if keys.count(one) > 1})
        if twice:
            raise ValueError(f"{', '.join(twice)} is mapped twice; give each station or floor its own number")
        if not keys:
            raise ValueError("maps no measurement: give at least one channel in addition to time")
        if self.dt is not None and self.rate is not None and not math.isclose(self.dt * self.rate, 1, rel_tol=1e-9):
            raise ValueError(f"dt {self.dt:g} s and rate {self.rate:g} Hz contradict each other; give only one of them")
        if self.start is not None and self.stop is not None and self.stop <= self.start:
            raise ValueError(f"stop {self.stop:g} s needs to be after start {self.start:g} s")
        return self

    @property
    def step(self) -> float | None:
        """Step (s) where no column is time."""
        return self.dt if self.dt is not None else None if self.rate is None else 1 / self.rate

    def step_of(self, channel: ColumnMap) -> float | None:
        """Step (s) that the mapping gives a channel; None where a time column or the file gives it."""
        if channel.rate is not None:
            return 1 / channel.rate
        timed = channel.role == "t" or channel.time is not None or bool(self.times)
        return None if timed else self.step

    @property
    def times(self) -> tuple[ColumnMap, ...]:
        return tuple(channel for channel in self.channels if channel.role == "t")

    @property
    def measurements(self) -> tuple[ColumnMap, ...]:
        return tuple(channel for channel in self.channels if channel.role != "t")

    @classmethod
    def read(cls, data: Any) -> Mapping:
        """The mapping in `data`. Raises MeasuredError with every issue."""
        try:
            return validated(cls, data)
        except PlanError as error:
            raise MeasuredError(_under(issue) for issue in error.issues) from None

    @classmethod
    def from_yaml(cls, text: str) -> Mapping:
        """The mapping in a YAML text. Raises MeasuredError with every issue."""
        try:
            data = plan_yaml.parse(text)
        except PlanError as error:
            raise MeasuredError(_under(issue) for issue in error.issues) from None
        if not isinstance(data, dict):
            raise MeasuredError(Issue("mapping", "is not a mapping of fields", fix="start from a guessed mapping"))
        return cls.read(data)

    def as_dict(self) -> dict[str, Any]:
        return self.model_dump(mode="json", by_alias=True)


def _unit(text: str) -> str:
    """The unit of UNITS that `text` names. Raises ValueError where it names none, or a unit that is not known."""
    written = unit_names.read(text)
    if written.plain in UNITS:
        return written.plain
    if written.unit and written.scale != 1.0:
        raise ValueError(f"is {written.scale:g} of {written.unit}: give the unit {written.unit} and the gain {written.scale:g}")
    problem = f"{written.problem}; " if written.problem else ""
    raise ValueError(f"is not a known unit of a column; {problem}the known units are {', '.join(UNITS)}")


def _divisor(unit: str) -> str:
    """A unit as it stands under a fraction line: `(mV/V)`."""
    return f"({unit})" if "/" in unit else unit


def _quotients(text: str) -> list[tuple[str, str]]:
    """Every reading of `above/below` as two units: `kN/V`, and `kN/mV/V` as kN over mV/V."""
    cuts = [at for at, sign in enumerate(text) if sign == "/"]
    read = [(unit_names.known(text[:at]), unit_names.known(text[at + 1 :])) for at in cuts]
    return [(above, below) for above, below in read if above and below]


def _under(issue: Issue) -> Issue:
    where = f"mapping.{issue.where}" if issue.where else "mapping"
    return Issue(where, issue.problem.replace("the plan", "the mapping"), issue.value, issue.fix)


def _example(kind: str) -> str:
    return {"force": "kN", "length": "mm", "velocity": "mm/s", "acceleration": "g", "current": "A"}.get(kind, "1")
