"""A plan under the recorded excitation moves as the recording does. Another excitation is recognised."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.excitation import Excitation, differences, lead, under_recorded
from rths_engine.recordings.measured import Measured, MeasuredChannel
from rths_engine.running.run import simulate
from tests.engine.plans import building

RATE = 256.0
TIME = np.arange(1024) / RATE
LIBRARY = MotionLibrary(None)
UNITS = {"ag": "m/s^2", "f_meas": "N", "force_ext": "N"}
RECORD = {"kind": "record", "record": "imperial-valley-1940-el-centro-ns"}


def measured(test: str, dt: float = 1 / RATE, of_run: bool = False, **channels: Array) -> Measured:
    numbered = {"ag": None, "drive": None}
    found = [MeasuredChannel(role, numbered.get(role, 1), values, UNITS.get(role, "m")) for role, values in channels.items()]
    return Measured(dt, tuple(found), test=test, of_run=of_run)


def plan(test: str = "specimen", **more: Any) -> Plan:
    rig = {"compensator": {"kind": "none"}, "specimen": {"kind": "linear", "stiffness": 1e6, "damping": 1e4}, **more}
    drive = {"amplitude": 0.01, "shape": {"kind": "sine", "cycles": 2}}
    return read_plan({"test": test, "stations": [rig], "controller_rate": RATE, "drive": drive})


def moved(planned: Plan) -> Array:
    return simulate(read_plan(planned.as_dict()), LIBRARY).signal("x_meas.1")


def test_a_specimen_follows_the_recorded_displacement_itself_where_no_command_was_recorded() -> None:
    x = 0.3 * np.sin(2 * np.pi * TIME) ** 3  # beyond the limits of the plan, which are raised
    recording = measured("specimen", x_meas=x, f_meas=1e6 * x)
    late = {"kind": "first_order_delay", "alpha": 30}
    found = under_recorded(plan(actuator=late), recording, LIBRARY)
    assert found.stations[0].actuator.model_dump()["alpha"] == 1 and found.duration == pytest.approx(TIME[-1])
    assert moved(found) == pytest.approx(x[1:], abs=1e-4)
    assert differences(found, recording, LIBRARY) == [] and under_recorded(found, recording, LIBRARY) is found


def test_an_actuator_stays_between_the_recorded_command_and_the_specimen() -> None:
    command = 0.02 * np.sin(2 * np.pi * TIME)
    recording = measured("specimen", x_cmd=command, x_meas=0.9 * command, f_meas=command)
    planned = plan(actuator={"kind": "first_order_delay", "alpha": 8})
    found = under_recorded(planned, recording, LIBRARY)
    assert found.stations[0].actuator == planned.stations[0].actuator
    assert np.allclose(found.drive.sample(TIME), command, atol=1e-9)


def test_a_command_that_starts_away_from_zero_follows_a_ramp_of_a_second() -> None:
    x = 0.01 + 0.005 * np.sin(2 * np.pi * TIME)
    recording = measured("specimen", x_meas=x, f_meas=x)
    found = under_recorded(plan(), recording, LIBRARY)
    assert lead(found, recording) == 1.0 and lead(plan(), recording) == 0.0
    assert found.drive.sample(np.array([0.0]))[0] == 0.0 and found.drive.sample(1 + TIME) == pytest.approx(x, abs=1e-4)
    assert differences(found, recording, LIBRARY) == []


def test_the_recorded_ground_motion_and_forces_replace_those_of_a_structure() -> None:
    ground, push = np.sin(2 * np.pi * TIME), 1e4 * np.cos(TIME)
    recording = measured("structure", ag=ground, force_ext=push, x_floor=0.01 * ground)
    planned = read_plan({"test": "structure", "structure": building([1e5], [1e7]), "motion": RECORD})
    named = [one.what for one in differences(planned, recording, LIBRARY)]
    assert named == ["ground motion", "force on floor 1"]
    found = under_recorded(planned, recording, LIBRARY)
    assert found.motion.kind == "inline" and found.forces[0].sample(TIME) == pytest.approx(push, rel=1e-6)
    assert differences(found, recording, LIBRARY) == []
    assert "the ground motion differs by" in str(differences(planned, recording, LIBRARY)[0])


def test_a_constant_current_is_held_and_a_varying_one_differs() -> None:
    x = 0.01 * np.sin(2 * np.pi * TIME)
    commanded: dict[str, Any] = {"specimen": {"kind": "mr_damper_current"}, "controller": {"kind": "constant", "current": 1.0}}
    held = measured("specimen", x_meas=x, f_meas=x, current=2.0 + 0.01 * np.sin(TIME))
    found = under_recorded(plan(**commanded), held, LIBRARY)
    assert found.stations[0].controller.model_dump()["current"] == pytest.approx(2.0, abs=0.01)
    assert differences(found, held, LIBRARY) == []
    varying = measured("specimen", x_meas=x, f_meas=x, current=1.0 + np.sin(TIME))
    left = differences(under_recorded(plan(**commanded), varying, LIBRARY), varying, LIBRARY)
    assert [one.what for one in left] == ["current"]


def test_the_plan_of_a_run_is_left_as_it_is() -> None:
    own = plan()
    ran = simulate(own, LIBRARY)
    recording = measured("specimen", of_run=True, x_cmd=ran.signal("x_cmd.1"), x_meas=ran.signal("x_meas.1"))
    assert under_recorded(own, recording, LIBRARY) is own
    larger = own.model_copy(update={"drive": own.drive.model_copy(update={"amplitude": 0.011})})
    assert under_recorded(larger, recording, LIBRARY).drive.sample(Excitation(own, recording).time) == pytest.approx(
        ran.signal("x_cmd.1"), abs=1e-8
    )


def test_a_recording_without_its_excitation_is_refused() -> None:
    still = measured("structure", x_floor=0 * TIME)
    with pytest.raises(RecordingError, match="does not contain the excitation of its test"):
        Excitation(read_plan({"test": "structure", "structure": building([1e5], [1e7]), "duration": 1.0}), still).planned()
    with pytest.raises(RecordingError, match="a plan holds at most"):
        Excitation(plan(), measured("specimen", x_meas=np.zeros(1_000_001))).planned()
    with pytest.raises(RecordingError, match="no command and no displacement"):
        _ = Excitation(plan("actuator"), measured("actuator", x_meas=np.sin(TIME))).command
