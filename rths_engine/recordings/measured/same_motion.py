"""Channels of a recording that measure the same thing, and the lag between them, which is offered, not applied."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

from rths_engine.recordings.measured import lag
from rths_engine.recordings.measured.importing import Signal
from rths_engine.recordings.measured.mapping import ColumnMap, Mapping
from rths_engine.recordings.measured.recording import Measured

# chosen; see docs/decisions/0023
MOST_PAIRS = 12  # each takes up to a third of a second

_OF_A_STATION = (("x_cmd", "x_meas"), ("x_comp", "x_meas"), ("x_cmd", "x_comp"))


@dataclass(frozen=True, slots=True)
class SameMotion:
    """Two channels that agree but for a factor and a lag. `behind` is later than `ahead` by `lag_s` (s, 95 %: low_s to high_s).

    `one_clock`: both have the same time stamps or the same rate, so that the lag is of the test, not of the recording.
    """

    ahead: str
    behind: str
    lag_s: float
    low_s: float
    high_s: float
    factor: float
    correlation: float
    one_clock: bool

    @property
    def sentence(self) -> str:
        """The lag with its interval, and what it can mean."""
        interval = f"95 %: {1e3 * self.low_s:.4g} to {1e3 * self.high_s:.4g} ms"
        about = f"{self.behind} is {1e3 * self.lag_s:.4g} ms behind {self.ahead} ({interval})"
        if self.low_s <= 0 <= self.high_s:
            return f"{about}: no lag is found between them."
        if self.one_clock:
            return f"{about}. Both have one clock, so this is the delay of the test itself, for example of the actuator."
        return f"{about}. They have different clocks: set the lag of {self.behind} if the two move together in the test."

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "sentence": self.sentence}


def found(measured: Measured, mapping: Mapping, signals: Iterable[Signal] = ()) -> tuple[SameMotion, ...]:
    """The lags between command and measured displacement, and between a force and an acceleration, where the two agree.

    `signals`, the samples of the file, tell the steps of the channels: different steps are different clocks.
    """
    steps = {one.channel.key: float(f"{one.clock.step:.9g}") for one in signals}
    clocks = {channel.key: (*_clock(channel, mapping), steps.get(channel.key)) for channel in mapping.measurements}
    values = {channel.key: channel.values for channel in measured.channels}
    results = []
    for ahead, behind in list(_pairs(measured))[:MOST_PAIRS]:
        one = lag.between(values[ahead], values[behind], measured.dt)
        if one is not None:
            same = clocks.get(ahead) == clocks.get(behind)
            results.append(SameMotion(ahead, behind, one.seconds, one.low, one.high, one.factor, one.correlation, same))
    return tuple(results)


def _pairs(measured: Measured) -> Iterator[tuple[str, str]]:
    for number in measured.numbers("station"):
        for ahead, behind in _OF_A_STATION:
            if measured.has(ahead, number) and measured.has(behind, number):
                yield f"{ahead}.{number}", f"{behind}.{number}"
    forces = [one.key for one in measured.channels if one.role in {"f_meas", "force_ext"}]
    accelerations = [one.key for one in measured.channels if one.role in {"a_floor", "ag"}]
    yield from ((force, acceleration) for acceleration in accelerations for force in forces)


def _clock(channel: ColumnMap, mapping: Mapping) -> tuple[str | None, float | None]:
    own = channel.time or (str(mapping.times[0].column) if mapping.times and channel.rate is None else None)
    return own, channel.rate
