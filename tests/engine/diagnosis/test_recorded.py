"""Which components a recording holds both ends of, and with what at them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.components import Actuator, Chain, Specimen, Structure, StructureData
from rths_engine.diagnosis.recorded import FAR_OFF, LEAST, components, foreseen, suspicious
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.sensor.offset import DisplacementOffset
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.measured import Measured, MeasuredChannel
from tests.engine.plans import building

RATE = 128.0
TIME = np.arange(640) / RATE
X = 0.02 * np.sin(2 * np.pi * 0.8 * TIME)
UNITS = {"x_cmd": "m", "x_comp": "m", "x_meas": "m", "f_meas": "N", "drive": "m", "current": "1", "ag": "m/s^2"}
STATION = {
    "compensator": {"kind": "none"},
    "actuator": {"kind": "first_order_delay", "alpha": 3.0},
    "specimen": {"kind": "linear", "stiffness": 2e6, "damping": 3e5},
}


def plan(test: str = "actuator", **station: Any) -> Plan:
    drive = {"amplitude": 0.02, "shape": {"kind": "sine"}}
    rig = {**STATION, **station}
    return read_plan({"test": test, "stations": [rig], "controller_rate": RATE, "drive": drive, "duration": 5.0})


def measured(**channels: Array) -> Measured:
    floors = {"x_floor": "m", "v_floor": "m/s", "a_floor": "m/s^2", "force_ext": "N"}
    found = []
    for name, values in channels.items():
        role, _, floor = name.partition("__")
        number = int(floor) if floor else (None if role in ("ag",) else 1)
        found.append(MeasuredChannel(role, number, values, (UNITS | floors)[role]))
    return Measured(1 / RATE, tuple(found))


def kinds(of: Plan, recording: Measured) -> list[type]:
    return [type(component) for component, _ in components(of, recording, "REC")]


def test_each_component_with_both_ends_recorded_is_looked_at() -> None:
    force = 2e6 * X
    assert kinds(plan(), measured(x_comp=X, x_meas=X)) == [Actuator]
    assert kinds(plan(), measured(x_comp=X, x_meas=X, f_meas=force)) == [Actuator, Specimen]
    assert kinds(plan("specimen"), measured(x_meas=X, f_meas=force)) == [Specimen]


def test_without_the_displacement_between_them_actuator_and_specimen_are_one_chain() -> None:
    ((chain, data),) = components(plan(), measured(x_comp=X, f_meas=2e6 * X), "REC")
    assert isinstance(chain, Chain) and chain.name == "specimen:1"
    assert data.command == pytest.approx(X) and data.raw[0] == pytest.approx(2e6 * X)


def test_a_channel_that_was_still_was_not_measured() -> None:
    assert kinds(plan(), measured(x_comp=X, x_meas=X, f_meas=np.zeros(640))) == [Actuator]
    with pytest.raises(RecordingError, match="has no component with recorded signals at both ends"):
        components(plan(), measured(x_comp=X, x_meas=np.full(640, 0.003)), "REC")


def test_what_the_actuator_was_sent_is_what_its_compensator_makes_of_the_command() -> None:
    """The inverse of a first-order delay: c[q] + (a - 1) (c[q] - c[q-1])."""
    compensated = plan(compensator={"kind": "inverse", "alpha_es": 4.0})
    ((_, data),) = components(compensated, measured(x_cmd=X, x_meas=X), "REC")
    assert data.command[1:] == pytest.approx(X[1:] + 3.0 * np.diff(X), abs=1e-12)
    ((_, same),) = components(plan(), measured(x_cmd=X, x_meas=X), "REC")
    assert same.command == pytest.approx(X)


def test_few_samples_other_rates_and_other_stations_are_refused() -> None:
    whole = measured(x_comp=X, x_meas=X)
    few = replace(whole, channels=tuple(replace(one, values=one.values[: LEAST - 1]) for one in whole.channels))
    with pytest.raises(RecordingError, match="has 199 samples; a diagnosis needs at least 200"):
        components(plan(), few, "REC")
    with pytest.raises(RecordingError, match="has a sampling rate of"):
        components(plan(), replace(whole, dt=1 / 100), "REC")
    with pytest.raises(RecordingError, match="has a channel of station 2"):
        components(plan(), replace(whole, channels=tuple(replace(one, number=2) for one in whole.channels)), "REC")


def test_the_specimen_is_told_where_its_actuator_moves_it_and_what_the_sensor_adds() -> None:
    delay, offset = FirstOrderDelay(alpha=3.0), DisplacementOffset(error=1e-3)
    pairs = components(plan(), measured(x_comp=X, x_meas=X + 1e-3, f_meas=2e6 * X), "REC")
    by_name = {component.name: data for component, data in pairs}
    actuator, specimen = (component for component, _ in pairs)
    assert isinstance(actuator, Actuator) and isinstance(specimen, Specimen)
    foreseen(actuator, [delay, offset], specimen, by_name)
    told = by_name["specimen:1"]
    assert told.x == pytest.approx(X, abs=1e-12)
    assert told.expected == pytest.approx(actuator.moved([delay], by_name["actuator:1"]), abs=1e-12)
    alone = {"specimen:1": told}
    foreseen(actuator, [delay], specimen, alone)
    assert alone["specimen:1"] is told


@pytest.mark.parametrize(
    ("factor", "doubted"), [(0.9 * FAR_OFF, False), (1.1 * FAR_OFF, True), (0.9 / FAR_OFF, True), (1.0, False)]
)
def test_an_output_thirty_times_off_has_a_wrong_unit(factor: float, doubted: bool) -> None:
    pairs = components(plan(), measured(x_comp=X, x_meas=X), "REC")
    actuator, data = pairs[0]
    true = actuator.predicted(actuator.base, data)[0]
    ((actuator, data),) = components(plan(), measured(x_comp=X, x_meas=factor * true), "REC")
    assert bool(suspicious([(actuator, data)])) is doubted


def structure_plan() -> Plan:
    return read_plan(
        {
            "test": "structure",
            "structure": building([1e4, 1e4], [4e6, 4e6], 0.02),
            "integrator": {"kind": "cr", "dt": 1 / RATE, "substeps": 1},
            "controller_rate": RATE,
            "duration": 5.0,
            "motion": {"kind": "inline", "dt": 1.0, "acceleration": [0.0] * 6},
        }
    )


def of_structure(**channels: Array) -> tuple[Structure, StructureData]:
    ((component, data),) = components(structure_plan(), measured(**channels), "REC")
    assert isinstance(component, Structure) and isinstance(data, StructureData)
    return component, data


def test_a_shaken_structure_begins_at_rest() -> None:
    _, data = of_structure(ag=np.sin(8 * TIME), x_floor__1=0.01 * TIME * np.sin(8 * TIME))
    assert data.released is None and data.floors[0][:2] == ("x", 1)
    assert data.ground == pytest.approx(np.sin(8 * TIME))


def test_a_structure_let_go_begins_where_a_cubic_through_its_first_samples_does() -> None:
    """A cosine of 12.4 rad/s over 0.12 of its first period: the cubic errs by (w t)^4 / 24 / 70 or so of the amplitude."""
    omega = float(2 * np.pi / Model(structure_plan()).periods[0])
    noise = 1e-5 * np.random.default_rng(1).standard_normal((2, 640))
    lower, upper = (size * np.cos(omega * TIME) + one for size, one in zip((0.01, 0.0162), noise, strict=True))
    _, data = of_structure(x_floor__1=lower, x_floor__2=upper)
    assert data.released is not None
    assert data.released[0] == pytest.approx((0.01, 0.0162), abs=5e-5)  # of the noise by 8 samples: 2 deviations
    assert np.abs(data.released[1]).max() < 0.1 * omega * 0.0162


def test_without_displacements_the_start_is_the_first_modes_at_minus_acceleration_over_omega_squared() -> None:
    """Golden ratio's mode of two equal storeys, 1 : 1.618."""
    omega = float(2 * np.pi / Model(structure_plan()).periods[0])
    _, data = of_structure(a_floor__2=-(omega**2) * 0.0162 * np.cos(omega * TIME))
    assert data.released is not None
    assert data.released[0] == pytest.approx((0.0162 / 1.618034, 0.0162), rel=2e-3)  # of the cubic through 8 samples


def test_a_structure_that_moves_by_nothing_recorded_is_refused() -> None:
    with pytest.raises(RecordingError, match="no ground acceleration or force was recorded"):
        components(structure_plan(), replace(measured(x_floor__1=X), of_run=True), "REC")
