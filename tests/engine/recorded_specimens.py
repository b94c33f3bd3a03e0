"""Recordings of a specimen test, as a laboratory would measure them."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.signal import lfilter

from rths_engine.foundation.part import Part
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.planning.shapes import BandNoise
from rths_engine.recordings.measured import Measured, MeasuredChannel
from rths_engine.running import replay

RATE, DURATION = 512.0, 12.0
FINER = 16
BASELINE = LinearSpecimen(stiffness=2.0e6, damping=8.0e5)


def plan(specimen: Part = BASELINE, **station: Any) -> Plan:
    """A specimen test without compensation."""
    rig = {"compensator": {"kind": "none"}, "specimen": specimen.model_dump(), **station}
    drive = {"amplitude": 0.02, "shape": {"kind": "sine"}}
    return read_plan({"test": "specimen", "stations": [rig], "controller_rate": RATE, "drive": drive, "duration": DURATION})


def recording(seed: int, *left_out: Effect, amplitude: float = 0.04, noise: float = 0.01) -> Measured:
    """With coloured noise on the force and 10 um on the displacement, of a specimen 4 % off its plan, in fine steps."""
    random = np.random.default_rng(seed)
    time = np.arange(int(DURATION * RATE) * FINER) / RATE / FINER
    fine = amplitude * BandNoise(low_frequency=0.1, high_frequency=2.5, duration=DURATION, seed=seed).sample(time)
    true = BASELINE.model_copy(update={"stiffness": 1.04 * BASELINE.stiffness, "damping": 0.96 * BASELINE.damping})
    force = replay.specimen(true, left_out, fine, np.ones(len(fine)), 1 / RATE / FINER)[::FINER]
    x = fine[::FINER]
    coloured = lfilter([np.sqrt(1 - 0.81)], [1, -0.9], random.standard_normal(len(x)))
    read = (x + 1e-5 * random.standard_normal(len(x)), force + noise * np.std(force) * coloured)
    return Measured(1 / RATE, (MeasuredChannel("x_meas", 1, read[0], "m"), MeasuredChannel("f_meas", 1, read[1], "N")))
