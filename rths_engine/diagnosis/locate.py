"""Location of the residual of the planned model in time, in frequency, and over displacement and velocity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rths_engine.diagnosis.judge import Judged
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
WINDOW = 1.0  # s
CLEARLY, FEWEST = 2.5, 20  # times the mean power elsewhere; fewest samples for a mean
BEYOND = 3.0  # standard deviations of the noise


@dataclass(frozen=True)
class Place:
    """Location of a residual that exceeds the noise: time spans (s), bands (Hz) and a region of the state in words.

    `middle` is the middle of each window (s). `level` is the RMS residual in each window in standard deviations of the noise;
    it is infinite where the simulation diverges.
    """

    times: list[tuple[float, float]]
    bands: list[tuple[float, float]]
    state: str
    middle: Array
    level: Array


def place(one: Judged, parts: Sequence[Part] | None = None) -> Place:
    """Locate the residual of a component's model, by default of its planned model, in time, frequency and state."""
    parts = one.selection.baseline.parts if parts is None else parts
    data, residual = one.recordings.data[0], one.recordings.residuals(parts)[0]
    noise = np.array([max(model.deviation, 1e-300) for model in one.recordings.noises])
    scaled = residual / noise[:, None]
    width = max(1, min(round(WINDOW / data.step), scaled.shape[1] // 8))
    count = scaled.shape[1] // width
    level = np.sqrt(np.mean(scaled[:, : count * width].reshape(len(noise), count, width) ** 2, axis=(0, 2)))
    level = np.where(np.isfinite(level), level, np.inf)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], (level > BEYOND).astype(int), [0]])))
    at = data.start + np.arange(count + 1) * width * data.step
    times = [(float(at[a]), float(at[b])) for a, b in edges.reshape(-1, 2)]
    return Place(times, _bands(residual, data.step), _state(one, scaled[0]), at[:-1] + 0.5 * width * data.step, level)


def _bands(residual: Array, step: float) -> list[tuple[float, float]]:
    power = np.sum(np.abs(np.fft.rfft(residual - residual.mean(axis=1, keepdims=True), axis=1)) ** 2, axis=0)
    if not power.sum() > 0:
        return []
    total = np.cumsum(power) / power.sum()
    frequency = np.fft.rfftfreq(residual.shape[1], step)
    return [(float(frequency[np.searchsorted(total, 0.05)]), float(frequency[np.searchsorted(total, 0.95)]))]


def _state(one: Judged, scaled: Array) -> str:
    """The region of displacement or velocity where the residual is largest, in words; may be empty."""
    x, v = one.component.signals(one.recordings.data[0])
    energy = scaled**2
    if not energy.sum() > 0:
        return ""
    words = []
    for signal in (x, v):
        size = np.abs(signal.values) / max(float(np.max(np.abs(signal.values))), 1e-300)
        share = [float(np.mean(energy[where])) if where.sum() > FEWEST else np.nan for where in _thirds(size)]
        if np.isfinite(share).all():
            low, _, high = share
            if high > CLEARLY * low:
                words.append(f"grows with {signal.label}")
            elif low > CLEARLY * high:
                words.append(f"largest at small {signal.label}")
    signs = np.sign(v.values)
    up, down = (
        float(np.mean(scaled[signs > 0])) if (signs > 0).any() else 0.0,
        float(np.mean(scaled[signs < 0])) if (signs < 0).any() else 0.0,
    )
    if abs(up - down) > 0.5 * float(np.sqrt(np.mean(energy))):
        words.append(f"changes sign with the {v.label}" if up * down < 0 else f"depends on the sign of the {v.label}")
    return ", ".join(words)


def _thirds(size: Array) -> list[NDArray[np.bool_]]:
    return [size < 0.33, (size >= 0.33) & (size < 0.67), size >= 0.67]
