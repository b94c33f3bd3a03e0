"""Specimens and actuators that are FMUs of FMI 3.0 and 2.0."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rths_engine.identification import RandomTest, identify
from rths_engine.parts.connections.connection import RigError
from rths_engine.planning.safety import Stop
from rths_engine.running.opening import opened
from rths_engine.running.run import Run
from tests.engine import built_fmu
from tests.engine.external_plans import DIRECT, RATE, driven, emulated, executed, hybrid, station
from tests.engine.plans import LIBRARY

FASTEST = {"kind": "fastest"}
LAG = 0.02  # s, of the built FMU


@pytest.fixture(scope="module")
def units(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("fmu")
    return {
        "third": built_fmu.build(folder, 3),
        "second": built_fmu.build(folder, 2),
        "direct": built_fmu.build(folder, 3, lagging=False),
    }


def fmu(path: Path, **more: Any) -> dict[str, Any]:
    return {"kind": "fmu", "path": str(path), **more}


def signal(run: Run, key: str) -> np.ndarray:
    return run.signals[: run.done, [channel.key for channel in run.channels].index(key)]


def lagged(command: np.ndarray) -> np.ndarray:
    """x[q] = a x[q-1] + (1 - a) u[q] with a = exp(-dt / T): the lag under an input that is held during each step."""
    a, x, found = math.exp(-1 / RATE / LAG), 0.0, []
    for u in command:
        x = a * x + (1 - a) * u
        found.append(x)
    return np.array(found)


@pytest.mark.parametrize("version", ["third", "second"])
def test_an_actuator_and_specimen_as_an_fmu_answer_in_the_step_of_their_command(units: dict[str, Path], version: str) -> None:
    run = executed(hybrid(station(1, fmu(units[version], displacement="displacement")), station(2), pace=FASTEST))
    assert run.trip is None
    x_comp, x_meas, f_meas = (signal(run, f"{role}.1") for role in ("x_comp", "x_meas", "f_meas"))
    assert np.abs(x_comp).max() > 1e-3
    assert np.allclose(x_meas, lagged(x_comp), rtol=1e-9, atol=1e-15)
    assert np.allclose(f_meas, 2e6 * x_meas, rtol=1e-12)


def test_a_specimen_as_an_fmu_that_the_plans_actuator_moves_equals_its_emulation(units: dict[str, Path]) -> None:
    slow = {"kind": "first_order_delay", "alpha": 5.0, "velocity_limit": 10.0, "force_limit": 1e8}
    effects = {"actuator_physics": [{"kind": "gain_error"}]}
    for more in ({}, effects):
        plan = hybrid(station(1, fmu(units["direct"]), actuator=slow, **more), station(2), pace=FASTEST)
        run, model = executed(plan), emulated(plan)
        assert run.trip is None and not np.allclose(signal(run, "x_comp.1"), signal(run, "x_meas.1"), rtol=0.05)
        assert np.allclose(run.signals, model.signals, rtol=1e-9, atol=1e-12)


def test_an_actuator_as_an_fmu_is_loaded_by_the_plans_specimen_and_read_by_its_sensors(units: dict[str, Path]) -> None:
    connection = fmu(units["third"], displacement="displacement", force="")
    noise = {"displacement": 1e-5, "force": 10.0}
    run = executed(hybrid(station(1, connection, noise=noise), pace=FASTEST))
    x_true = lagged(signal(run, "x_comp.1"))
    assert np.std(signal(run, "x_meas.1") - x_true) == pytest.approx(1e-5, rel=0.2)
    assert np.std(signal(run, "f_meas.1") - 2e6 * x_true) == pytest.approx(10.0, rel=0.2)


def test_the_lag_behind_a_ramp_is_that_of_a_command_given_for_the_end_of_each_step(units: dict[str, Path]) -> None:
    """FMI holds the input during a step. Given for its start, the lag would be one step more: dt / (1 - a)."""
    shape = {"kind": "triangle", "frequency": 0.5, "cycles": 0.25}
    run = executed(driven(station(1, fmu(units["third"], displacement="displacement")), shape, pace=FASTEST))
    dt, a, speed = 1 / RATE, math.exp(-1 / RATE / LAG), 4 * 0.5 * 0.01
    lag = (signal(run, "x_comp.1") - signal(run, "x_meas.1"))[100:120] / speed
    assert np.allclose(lag, dt * a / (1 - a), rtol=1e-3)
    assert np.allclose(lag, LAG - dt / 2, rtol=0.02) and not np.any(np.isclose(lag, dt / (1 - a), rtol=0.05))


@pytest.mark.parametrize(
    ("amplitude", "what"),
    [(0.045, "failed: fmi3DoStep failed with status 3"), (-0.045, "it sent a force that is not a number")],
)
def test_an_fmu_that_fails_or_computes_no_number_ends_the_test_with_what_was_recorded(
    units: dict[str, Path], amplitude: float, what: str
) -> None:
    wide = {"displacement": 0.1, "velocity": 2.0, "force": 5e5}
    shape = {"kind": "triangle", "frequency": 0.5, "cycles": 1}
    run = executed(driven(station(1, fmu(units["third"]), limits=wide), shape, pace=FASTEST, amplitude=amplitude))
    assert isinstance(run.trip, Stop) and what in run.trip.sentence and "lost its rig, FMU rig3.fmu" in run.trip.sentence
    assert 0.03 < np.abs(signal(run, "x_meas.1")).max() <= 0.04


def test_a_current_reaches_the_fmu(units: dict[str, Path]) -> None:
    """The built FMU adds 1 kN for an ampere."""
    mr = {"specimen": {"kind": "mr_damper_current"}, "controller": {"kind": "constant", "current": 1.5}}
    run = executed(hybrid(station(1, fmu(units["direct"], current="current"), **mr), pace=FASTEST))
    assert np.allclose(signal(run, "f_meas.1"), 2e6 * signal(run, "x_meas.1") + 1500.0)


@pytest.mark.parametrize(
    ("more", "where", "problem"),
    [
        ({"displacement_unit": "m"}, "command", "is in mm (0.001 m), but the plan gives m"),
        ({"force_unit": "N"}, "force", "is in kN (1000 kg m s^-2), but the plan gives N"),
        ({"command": "force"}, "command", "is not an input of the FMU that is a number"),
        ({"force": "torque"}, "force", "its outputs are: displacement, force"),
    ],
)
def test_an_fmu_that_contradicts_the_plan_is_refused(units: dict[str, Path], more: Any, where: str, problem: str) -> None:
    with pytest.raises(RigError) as refused:
        executed(hybrid(station(1, fmu(units["second"], **more)), pace=FASTEST))
    assert refused.value.issues[0].where == f"stations.0.connection.{where}" and problem in str(refused.value)


def test_the_service_opens_only_files_of_its_own_folder(units: dict[str, Path], tmp_path: Path) -> None:
    for path, problem in ((str(units["third"]), "is not the name of a file"), ("rig3.fmu", "does not exist")):
        plan = hybrid(station(1, fmu(Path(path))), pace=FASTEST)
        with pytest.raises(RigError, match=problem), opened(plan, LIBRARY, tmp_path):
            pass
    with opened(hybrid(station(1, fmu(Path("rig3.fmu"))), pace=FASTEST), LIBRARY, units["third"].parent) as run:
        run.advance(10)
    assert run.trip is None


def test_a_name_that_is_too_long_is_refused_without_the_folder(tmp_path: Path) -> None:
    plan = hybrid(station(1, fmu(Path("a" * 300))), pace=FASTEST)
    with pytest.raises(RigError, match="cannot be opened: File name too long") as refused, opened(plan, LIBRARY, tmp_path):
        pass
    assert str(tmp_path) not in str(refused.value)


def test_a_file_that_is_no_fmu_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("fmpy")
    (tmp_path / "text.fmu").write_text("not an archive")
    with pytest.raises(RigError, match="cannot be opened"):
        executed(hybrid(station(1, fmu(tmp_path / "text.fmu")), pace=FASTEST))


def test_the_lag_of_an_fmu_is_identified_on_the_rig_and_else_that_of_its_model(units: dict[str, Path]) -> None:
    rig = fmu(units["third"], displacement="displacement")
    compensator = {"kind": "inverse", "alpha_es": 3.0}
    plan = hybrid(station(1, rig, compensator=compensator, actuator={**DIRECT, "alpha": 9}), pace=FASTEST)
    quick = RandomTest(seconds=5)
    on_rig, model = identify(plan, 1, quick, on_rig=True), identify(plan, 1, quick)
    assert on_rig["suggested"][0]["value"] == pytest.approx(1 / (1 - math.exp(-1 / RATE / LAG)), rel=1e-3)
    assert model["suggested"][0]["value"] == pytest.approx(9.0, rel=1e-3)
    assert "no rig was moved" in model["notes"][0]
