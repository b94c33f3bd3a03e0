"""Every part in the compiled loop of whole runs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.parts import actuators, compensators, controllers, specimens
from rths_engine.parts.actuators.interacting import InteractingActuator
from rths_engine.running.run import simulate
from tests.engine.plans import LIBRARY, NO_LIMITS, building, completed, make, shaking

TIME = np.arange(801) * 0.01
MOTION = shaking(0.2 * np.sin(2 * np.pi * 0.9 * TIME) * np.sin(np.pi * TIME / 8) ** 2, 0.01)
STRUCTURE = building([2.0e6], [8.0e7], 0.05)  # 1.0 Hz; heavy beside one damper, so that a late force can't upset it


def kind(part: type[Any]) -> dict[str, Any]:
    return {"kind": part.model_fields["kind"].default}


# this actuator is unstable with a specimen much stiffer than the load that it carries
SUITED = {InteractingActuator: {"specimen": {"kind": "linear_with_mass"}}}


def station(name: str, **parts: dict[str, Any]) -> dict[str, Any]:
    chosen = {"compensator": {"kind": "none"}, "actuator": {"kind": "first_order_delay"}, "specimen": {"kind": "linear"}}
    return {"name": name, "storey": 1, "limits": NO_LIMITS, **chosen, **parts}


def test_every_part_runs_in_the_loop_beside_every_other() -> None:
    registries = {"compensator": compensators, "actuator": actuators, "specimen": specimens, "controller": controllers}
    stations = [
        station(f"{slot} {part.title}", **{"controller": {"kind": "constant"}, **SUITED.get(part, {}), slot: kind(part)})
        for slot, registry in registries.items()
        for part in registry.KINDS
    ]
    run = completed(make(STRUCTURE, MOTION, 10 / 1024, substeps=10, stations=stations))
    assert np.isfinite(run.signals).all()
    result = run.result("completed", 0.0)
    for number in range(1, len(stations) + 1):
        assert np.ptp(result.signal(f"x_meas.{number}")) > 1e-3
        if stations[number - 1]["specimen"] != {"kind": "none"}:
            assert np.ptp(result.signal(f"f_meas.{number}")) > 100.0


@pytest.mark.parametrize("specimen", ["mr_damper", "linear", "elastomeric"])
def test_ats_tracks_with_a_servo_hydraulic_actuator_where_a_wrong_estimate_does_not(specimen: str) -> None:
    errors = {}
    for name, compensator in {"ats": {"kind": "ats", "delay": 0.01}, "inverse": {"kind": "inverse", "alpha_es": 11}}.items():
        parts: dict[str, Any] = {"actuator": {"kind": "servo_hydraulic"}, "specimen": {"kind": specimen}}
        parts["compensator"] = compensator
        noise = {"displacement": 1e-5, "force": 200.0}
        plan = make(STRUCTURE, MOTION, 10 / 1024, substeps=10, stations=[{**station("Damper", **parts), "noise": noise}])
        result = simulate(plan, LIBRARY)
        assert result.status == "completed"
        errors[name] = result.summary()["stations"][0]["rms_percent"]
    assert errors["ats"] < 1.0 < 0.1 * errors["inverse"]  # percent
