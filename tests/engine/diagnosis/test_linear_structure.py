"""A shear building fitted to the floors of a building is that building."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.linear import linear_plan
from rths_engine.diagnosis.linear_structure import fitted_building
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.measured import Measured, MeasuredChannel
from rths_engine.running.run import simulate
from tests.engine.plans import building

RATE = 100.0
TIME = np.arange(800) / RATE


def measured(ground: Array | None = None, **floors: Array) -> Measured:
    rows = [MeasuredChannel(name[:-2], int(name[-1]), values, "m") for name, values in floors.items()]
    if ground is not None:
        rows.append(MeasuredChannel("ag", None, ground, "m/s^2"))
    return Measured(1 / RATE, tuple(rows), test="structure")


def decay(frequency: float, damping: float) -> Array:
    omega = 2 * np.pi * frequency
    late = omega * np.sqrt(1 - damping**2) * TIME
    found: Array = 0.02 * np.exp(-damping * omega * TIME) * (np.cos(late) + damping / np.sqrt(1 - damping**2) * np.sin(late))
    return found


def test_the_period_and_the_damping_of_a_decay_are_fitted_beside_the_zero_of_its_sensor() -> None:
    building, words = fitted_building(measured(x_floor_1=decay(1.7, 0.03) + 1e-5))
    (storey,) = building.storeys
    assert np.sqrt(storey.stiffness / storey.mass) / 2 / np.pi == pytest.approx(1.7, rel=0.005)
    assert building.damping_ratio == pytest.approx(0.03, rel=0.1)
    assert "1000 kg is a scale" in words


def test_the_ratios_of_stiffnesses_and_masses_are_fitted_where_all_floors_were_measured() -> None:
    shape = {"kind": "band_noise", "high_frequency": 8.0, "duration": 8.0}
    true = {"structure": building([2e5, 1e5], [1.2e8, 0.8e8], 0.03), "forces": [{"floor": 2, "amplitude": 1e5, "shape": shape}]}
    rates = {"controller_rate": 200, "integrator": {"kind": "cr", "dt": 0.005, "substeps": 1}}
    ran = simulate(read_plan({"test": "structure", **true, **rates}), MotionLibrary(None))
    floors = {f"x_floor_{number}": ran.signal(f"x_floor.{number}") for number in (1, 2)}
    push = MeasuredChannel("force_ext", 2, ran.signal("force_ext.2"), "N")
    read = measured(**floors)
    found, words = fitted_building(replace(read, dt=ran.dt, start=ran.dt, of_run=True, channels=(*read.channels, push)))
    assert [one.mass for one in found.storeys] == pytest.approx([2e5, 1e5], rel=0.01)
    assert [one.stiffness for one in found.storeys] == pytest.approx([1.2e8, 0.8e8], rel=0.01)
    assert found.damping_ratio == pytest.approx(0.03, rel=0.03) and "a scale" not in words


def test_the_plan_of_a_decay_starts_as_the_recording() -> None:
    found = linear_plan(measured(x_floor_1=decay(1.7, 0.03)))
    assert found.start.displacement[0] == pytest.approx(0.02, rel=0.01) and found.duration == pytest.approx(TIME[-1])


def test_floors_that_do_not_move_and_noise_are_refused() -> None:
    with pytest.raises(RecordingError, match="has no measured motion of a floor"):
        fitted_building(measured(x_floor_1=0 * TIME))
    noise = np.random.default_rng(1).standard_normal((2, len(TIME)))
    with pytest.raises(RecordingError, match="does not move like a linear structure"):
        fitted_building(measured(noise[0], x_floor_1=noise[1]))
