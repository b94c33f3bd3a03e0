"""Identification of a delay by a random test, against actuators whose delay is known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import signal

from rths_engine.foundation.errors import PlanError
from rths_engine.identification import RandomTest, estimates, identify
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan

DT = 1 / 1024
SHORT = RandomTest(seconds=8)


def planned(actuator: dict[str, Any], compensator: dict[str, Any] | None = None, **station: Any) -> Plan:
    data = templates.template("linear-damper").as_dict()
    compensator = compensator or {"kind": "inverse", "alpha_es": 20}
    noise = {"displacement": 1e-5, "force": 0.0}
    data["stations"][0] |= {"actuator": actuator, "noise": noise, "compensator": compensator, **station}
    return Plan.model_validate(data)


def model(found: dict[str, Any], kind: str) -> dict[str, Any]:
    return next(one for one in found["models"] if one["kind"] == kind)


@pytest.mark.parametrize("colour", [0.0, 0.9])
def test_the_interval_of_alpha_covers_the_true_value_as_often_as_it_says(colour: float) -> None:
    """40 noises, white and coloured: 95 % of 40 is 38, and fewer than 34 has a probability below 1 %."""
    alpha, seconds = 23.4, 6
    random = np.random.default_rng(7)
    band = signal.butter(4, [0.5, 6.0], "bandpass", fs=1024, output="sos")
    u = 1e-3 * signal.sosfilt(band, random.normal(size=(40, seconds * 1024)))
    covered = 0
    for command in u:
        noise = signal.lfilter([1.0], [1.0, -colour], random.normal(scale=2e-5, size=len(command)))
        y = signal.lfilter([1 / alpha], [1.0, 1 / alpha - 1], command) + noise
        found = estimates.first_order(command, y, DT, 6.0, 0.02).values["alpha"]
        covered += found.low <= alpha <= found.high
    assert covered >= 34


@pytest.mark.parametrize(("low", "high"), [(0.25, 6.0), (49.9, 99.8)])
def test_an_estimate_does_not_depend_on_the_size_of_the_signals(low: float, high: float) -> None:
    band = signal.butter(4, [low, high], "bandpass", fs=1024, output="sos")
    u = signal.sosfilt(band, np.random.default_rng(3).normal(size=5 * 1024))
    y = signal.lfilter([1 / 20], [1.0, 1 / 20 - 1], u)
    for size in (1e-3, 1e-9):
        assert estimates.first_order(size * u, size * y, DT, high, 0.002).values["alpha"].value == pytest.approx(20, rel=1e-6)


@pytest.mark.parametrize(
    "settings", [{"amplitude": 2e-5}, {"low_frequency": 49.9, "high_frequency": 99.8}], ids=["small", "fast"]
)
def test_a_linear_actuator_has_the_same_delay_at_every_amplitude(settings: dict[str, float]) -> None:
    plan = planned({"kind": "first_order_delay", "alpha": 20}, noise={"displacement": 0.0, "force": 0.0})
    found = identify(plan, 1, RandomTest(seconds=5, **settings))
    assert found["smaller_amplitude"]["alpha"]["value"] == pytest.approx(20, rel=1e-4)
    assert "depends on the amplitude" not in " ".join(found["notes"])


def test_limits_that_leave_no_amplitude_are_told() -> None:
    limits = {"displacement": 1e-300, "velocity": 0.3, "force": 1e9, "oscillation": 0}
    with pytest.raises(PlanError, match="within the limits of the station"):
        identify(planned({"kind": "first_order_delay"}, limits=limits), 1, RandomTest(seconds=5))


def test_a_first_order_actuator_is_identified_and_its_alpha_suggested() -> None:
    found = identify(planned({"kind": "first_order_delay", "alpha": 30}), 1, SHORT)
    assert found["best"] == "first_order"
    alpha = model(found, "first_order")["parameters"][0]
    assert alpha["value"] == pytest.approx(30, abs=0.1)
    assert 0 < alpha["high"] - alpha["low"] < 0.2
    assert found["delay"]["value"] == pytest.approx(29 * DT, rel=5e-3)
    (field,) = found["suggested"]
    assert (field["path"], field["present"]) == ("stations.0.compensator.alpha_es", 20)
    assert field["value"] == pytest.approx(30, abs=0.1)
    assert found["notes"] == []


def test_a_second_order_actuator_gives_its_frequency_damping_and_dead_time() -> None:
    actuator = {"kind": "second_order", "frequency": 12.0, "damping_ratio": 0.8, "dead_time": 0.006}
    found = identify(planned(actuator, {"kind": "robust"}), 1, SHORT)
    assert found["best"] == "second_order"
    values = {one["key"]: one["value"] for one in model(found, "second_order")["parameters"]}
    assert all(one["determined"] for one in model(found, "second_order")["parameters"])
    assert values["frequency"] == pytest.approx(12.0, rel=0.03)
    assert values["damping_ratio"] == pytest.approx(0.8, rel=0.03)
    assert values["dead_time"] == pytest.approx(0.006, abs=4e-4)
    suggested = {one["field"]: one["value"] for one in found["suggested"]}
    assert suggested["delay"] == pytest.approx(found["delay"]["value"], rel=1e-3)
    assert {"gain", "delay", "frequency", "damping_ratio"} == suggested.keys()


def test_a_servo_hydraulic_actuator_has_the_delay_of_its_position_loop() -> None:
    """On a ramp it lags T - dt (see its docstring); the phase over the band turns less, as that of its lags does."""
    found = identify(planned({"kind": "servo_hydraulic", "time_constant": 0.025, "force_limit": 1e8}), 1, SHORT)
    assert found["delay"]["value"] == pytest.approx(0.025 - DT, rel=0.02)
    f = np.linspace(SHORT.low_frequency, SHORT.high_frequency, 50)
    s = 2j * np.pi * f
    slope = -np.unwrap(np.angle(1 / (0.025 * 0.004 * s**2 + 0.025 * s + 1))) - 2 * np.pi * f * -DT
    late = model(found, "pure_delay")["delay"]
    assert late["value"] == pytest.approx(float(np.sum(slope * f) / np.sum(f**2)) / (2 * np.pi), rel=0.08)


def test_a_delay_that_depends_on_the_amplitude_is_reported() -> None:
    idle = [{"kind": "dead_band", "half_width": 1e-4}]
    found = identify(planned({"kind": "first_order_delay"}, actuator_physics=idle), 1, RandomTest(seconds=5, amplitude=2e-3))
    assert "depends on the amplitude" in " ".join(found["notes"])


@pytest.mark.parametrize(
    ("number", "settings", "where"),
    [(3, {}, "station"), (1, {"amplitude": 0.5}, "amplitude"), (1, {"high_frequency": 100.0, "low_frequency": 40.0}, "")],
)
def test_a_test_that_cannot_run_is_refused(number: int, settings: dict[str, Any], where: str) -> None:
    data = planned({"kind": "first_order_delay"}).as_dict()
    data["controller_rate"] = 1024.0 if where else 512.0
    plan = Plan.model_validate(data)
    with pytest.raises(PlanError) as refused:
        identify(plan, number, RandomTest(seconds=5, **settings))
    assert refused.value.issues[0].where == (where or "high_frequency")


def test_a_test_that_trips_says_so() -> None:
    limits = {"displacement": 0.2, "velocity": 0.3, "force": 1.0, "oscillation": 0}
    with pytest.raises(PlanError, match="trips the random test"):
        identify(planned({"kind": "first_order_delay"}, limits=limits), 1, RandomTest(seconds=5))


@pytest.mark.parametrize("alpha", [20, 30])
def test_a_fit_at_its_bounds_determines_no_parameters(alpha: float) -> None:
    """The lag of first order is that of a second-order actuator with any frequency and a damping ratio that grows with it."""
    found = identify(planned({"kind": "first_order_delay", "alpha": alpha}), 1, RandomTest(seconds=5))
    second = {one["key"]: one["determined"] for one in model(found, "second_order")["parameters"]}
    assert second == {"gain": True, "frequency": False, "damping_ratio": False, "dead_time": False}
    assert all(one["determined"] for one in model(found, "first_order")["parameters"])


def test_no_rig_of_an_emulated_station_is_moved() -> None:
    with pytest.raises(PlanError, match="has no rig that could be moved") as refused:
        identify(planned({"kind": "first_order_delay"}), 1, RandomTest(seconds=5), on_rig=True)
    (issue,) = refused.value.issues
    assert issue.where == "stations.0.connection" and "--rig" in str(issue.fix)
