"""Tests beside the hybrid one: a specimen or an actuator driven alone, a structure without stations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.planning import checks
from rths_engine.planning.excitation import Drive
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from rths_engine.planning.shapes import SHAPES, BandNoise, Chirp, IncreasingCycles, Samples, Sine, Step, Still, Triangle
from tests.engine.plans import NO_LIMITS, building, completed, make

SINE = {"kind": "sine", "frequency": 0.5, "cycles": 4, "ramps": 1}
IDEAL = {"kind": "first_order_delay", "alpha": 1.0, "velocity_limit": 10.0, "force_limit": 1e8}
STILL = {"kind": "none"}


def driven(test: str, **more: Any) -> dict[str, Any]:
    station = {"compensator": {"kind": "none"}, "actuator": IDEAL, "specimen": LINEAR, "limits": NO_LIMITS}
    station |= more.pop("station", {})
    return {"test": test, "drive": {"amplitude": 0.02, "shape": SINE}, "stations": [station], **more}


LINEAR = {"kind": "linear", "stiffness": 2.0e6, "damping": 3.0e4}


def test_a_specimen_with_an_ideal_actuator_follows_the_drive_and_gives_its_force() -> None:
    run = completed(read_plan(driven("specimen")))
    result = run.result("completed", 0.0)
    time = np.arange(1, run.total + 1) * run.dt
    x = 0.02 * Sine(**SINE).sample(time)
    assert [channel.key for channel in run.channels][:2] == ["x_cmd.1", "x_comp.1"]
    assert result.signal("x_meas.1") == pytest.approx(x, abs=1e-15)
    velocity = np.diff(x, prepend=0.0) / run.dt
    assert result.signal("f_meas.1") == pytest.approx(2.0e6 * x + 3.0e4 * velocity, rel=1e-12, abs=1e-9)
    assert result.summary()["floors_peak_mm"] == []
    assert run.total == 8 * 1024


def test_an_actuator_tracks_its_command_with_its_own_lag() -> None:
    """First-order delay: behind a sine by the phase of z / (alpha z - (alpha - 1))."""
    actuator = {**IDEAL, "alpha": 30.0}
    plan = read_plan(driven("actuator", station={"actuator": actuator}))
    run = completed(plan)
    z = np.exp(2j * np.pi * 0.5 / 1024)
    gain = z / (30 * z - 29)
    middle = slice(3 * 1024, 5 * 1024)  # between the rise and the fall, one cycle after the rise
    time = np.arange(1, run.total + 1)[middle] * run.dt
    expected = 0.02 * np.abs(gain) * np.sin(2 * np.pi * 0.5 * time + np.angle(gain))
    # the memory of the rise decays as exp(-t / 29 ms)
    assert run.result("completed", 0.0).signal("x_meas.1")[middle] == pytest.approx(expected, abs=0.02 * 1e-6)


def test_a_test_without_a_structure_has_no_periods_and_no_digest_of_one() -> None:
    plan = read_plan(driven("specimen"))
    assert len(Model(plan).periods) == 0
    assert plan.driven and plan.step == plan.substep
    assert plan_from_yaml(plan_to_yaml(plan)).digest == plan.digest


def test_a_constant_force_holds_a_storey_at_force_over_stiffness() -> None:
    force = {"floor": 2, "amplitude": 5.0e4, "shape": {"kind": "step", "delay": 0.0, "rise": 2.0, "duration": 30.0}}
    plan = make(building([1e5, 1e5], [2e7, 1e7], 0.1), STILL, 0.01, test="structure", forces=[force])
    run = completed(plan)
    assert [channel.key for channel in run.channels] == ["ag", "force_ext.2", "x_floor.1", "x_floor.2"]
    # 10 % damping over 30 s: what the rise set off has decayed below rounding of the tolerance
    assert run.signals[-1] == pytest.approx([0.0, 5.0e4, 5.0e4 / 2e7, 5.0e4 * (1 / 2e7 + 1 / 1e7)], rel=1e-6)


@pytest.mark.parametrize(
    ("changed", "where", "told"),
    [
        ({"structure": building([1e5], [1e7])}, "structure", "not used in this kind of test"),
        ({"motion": {"kind": "inline", "dt": 0.1, "acceleration": [0.0, 1.0]}}, "motion", "not used"),
        ({"forces": [{"floor": 1}]}, "forces", "not used"),
        ({"start": {"displacement": [0.1]}}, "start", "not used"),
        ({"stations": []}, "stations", "exactly one"),
        ({"drive": {"shape": {"kind": "still"}}}, "drive.shape", "needs a drive"),
        ({"drive": {"amplitude": 0.02, "shape": {**SINE, "frequency": 200.0}}}, "drive.shape", "beyond the station's limit"),
        (
            {"drive": {"amplitude": 9.0, "shape": {**SINE, "frequency": 0.01}}, "station": {"limits": {}}},
            "drive.amplitude",
            "200 mm",
        ),
        ({"test": "hybrid"}, "structure", "computes a structure"),
        ({"test": "structure", "structure": building([1e5], [1e7])}, "stations", "a test of a structure alone has no stations"),
        ({"test": "hybrid", "structure": building([1e5], [1e7])}, "drive", "leave it at rest"),
    ],
)
def test_a_plan_that_does_not_fit_its_kind_of_test_is_told_where(changed: dict[str, Any], where: str, told: str) -> None:
    with pytest.raises(PlanError) as caught:
        read_plan(
            {
                **driven("specimen", **{k: v for k, v in changed.items() if k == "station"}),
                **{k: v for k, v in changed.items() if k != "station"},
            }
        )
    assert any(issue.where == where and told in str(issue) for issue in caught.value.issues), str(caught.value)


@pytest.mark.parametrize(
    ("changed", "where", "told"),
    [
        ({}, "duration", "give a duration"),
        ({"duration": 1.0, "forces": [{"floor": 3}]}, "forces.0.floor", "1 floors"),
        ({"duration": 1.0, "start": {"displacement": [0.1, 0.2]}}, "start.displacement", "give 1"),
        ({"duration": 1.0, "test": "hybrid", "start": {"velocity": [0.1]}}, "start", "starts from rest"),
    ],
)
def test_an_excitation_that_does_not_fit_the_structure_is_told_where(changed: dict[str, Any], where: str, told: str) -> None:
    with pytest.raises(PlanError) as caught:
        make(building([1e5], [1e7]), STILL, 0.01, **{"test": "structure", **changed})
    assert any(issue.where == where and told in str(issue) for issue in caught.value.issues), str(caught.value)


def test_a_velocity_limit_beyond_the_actuator_is_named_before_the_start() -> None:
    actuator = {"kind": "servo_hydraulic", "velocity_limit": 0.25}
    with pytest.raises(PlanError, match=r"stations\.0\.limits\.velocity.*300 mm/s, more than the actuator's limit of 250 mm/s"):
        read_plan(driven("specimen", station={"actuator": actuator, "limits": {}}))


MADE = [
    Still(),
    Sine(),
    Triangle(),
    IncreasingCycles(),
    Chirp(),
    BandNoise(),
    Step(),
    Samples(dt=0.5, values=(0.0, 1.0, -1.0, 0.0)),
]


@pytest.mark.parametrize("shape", MADE, ids=lambda shape: shape.kind)
def test_a_shape_starts_at_rest_and_stays_within_its_amplitude(shape: Any) -> None:
    time = np.arange(0, shape.duration + 1, 1 / 512)
    wave = shape.sample(time)
    assert abs(wave[0]) < 1e-12
    assert np.max(np.abs(wave)) <= 1 + 1e-12
    if not isinstance(shape, Still | Step):
        assert np.max(np.abs(wave)) > 0.9
        assert np.all(wave[time > shape.duration + 1e-9] == 0) or np.abs(wave[time > shape.duration + 1e-9]).max() < 1e-9


def test_every_shape_is_tried() -> None:
    assert {type(shape) for shape in MADE} == set(SHAPES)


def test_band_noise_has_no_power_outside_its_band() -> None:
    time = np.arange(0, 40, 1 / 128)
    wave = BandNoise(low_frequency=1.0, high_frequency=4.0).sample(time)
    power = np.abs(np.fft.rfft(wave)) ** 2
    frequency = np.fft.rfftfreq(len(time), 1 / 128)
    outside = (frequency < 0.5) | (frequency > 4.5)
    assert power[outside].sum() < 1e-4 * power.sum()  # the taper of 1 s widens each tone


USED: dict[str, Any] = {
    name: field.json_schema_extra.get("tests")
    for name, field in Plan.model_fields.items()
    if isinstance(field.json_schema_extra, dict)
}
OTHERWISE = {
    "motion": {"kind": "inline", "dt": 0.1, "acceleration": [0.0, 1.0]},
    "forces": [{"floor": 1}],
    "start": {"displacement": [0.1]},
    "drive": {"shape": SINE},
    "structure": building([1e5], [1e7]),
    "stations": [{}],
}


@pytest.mark.parametrize("test", ["hybrid", "specimen", "actuator", "structure"])
@pytest.mark.parametrize("field", OTHERWISE)
def test_a_field_declared_for_other_kinds_of_test_is_refused_and_one_for_this_kind_is_not(test: str, field: str) -> None:
    hybrid = {"structure": building([1e5], [1e7]), "duration": 1.0, "stations": [{}]}
    plain = driven(test) if test in ("specimen", "actuator") else {"test": test, **hybrid}
    if test == "structure":
        plain.pop("stations")
    read_plan(plain)
    changed = {**plain, field: OTHERWISE[field]}
    if test in USED[field]:
        read_plan(changed)
    else:
        with pytest.raises(PlanError, match=rf"^{field}\b"):
            read_plan(changed)


@pytest.mark.parametrize(("field", "value"), [("storey", 2), ("dampers", 6), ("equivalent_damping", 1e5)])
def test_what_a_station_stands_for_in_a_building_is_refused_in_a_test_without_one(field: str, value: float) -> None:
    with pytest.raises(PlanError, match=rf"stations\.0\.{field}.*not used in this kind of test"):
        read_plan(driven("specimen", station={field: value}))


@pytest.mark.parametrize("frequency", [1e-300, 1e-4])
def test_a_drive_without_end_is_refused_before_it_is_sampled(frequency: float) -> None:
    with pytest.raises(PlanError, match=r"drive\.shape.*: lasts .* s; the maximum is 3600 s"):
        read_plan(driven("specimen", drive={"shape": {**SINE, "frequency": frequency}}))


def test_a_long_drive_is_checked_against_its_limits_at_some_moments() -> None:
    sine = {"kind": "sine", "frequency": 1.0, "cycles": 3600, "ramps": 0}
    drive = Drive(amplitude=0.02, shape=Sine(**sine))
    displacement, velocity = checks.peaks(drive, 3600.0, 100_000.0)
    # 28 moments of every cycle: within half of 1/28 of a cycle from the peak, 1 - cos(pi / 28) = 0.6 % below it at most
    assert displacement == pytest.approx(0.02, rel=0.0063)
    assert velocity == pytest.approx(0.02 * 2 * np.pi, rel=0.0063)


def test_a_drive_that_starts_beside_zero_jumps() -> None:
    samples = {"kind": "samples", "dt": 1.0, "values": [1.0, 1.0]}
    with pytest.raises(PlanError, match=r"drive\.shape.*: reaches 2\.048e\+04 mm/s"):
        read_plan(driven("specimen", drive={"amplitude": 0.02, "shape": samples}))
