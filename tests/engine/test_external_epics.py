"""A rig behind EPICS process variables: a soft IOC in a process of its own, reached by Channel Access."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from rths_engine.parts.connections.connection import RigError
from rths_engine.planning.safety import Stop
from rths_engine.running.run import Run
from tests.engine.external_plans import emulated, executed, hybrid, station
from tests.engine.soft_ioc import NAMES, PROVEN, Ioc, alone

pytest.importorskip("aioca", reason="aioca is not installed: pip install -e '.[epics]'")
pytest.importorskip("softioc", reason="softioc is not installed: pip install -e '.[test]'")


@pytest.fixture(scope="module")
def ioc() -> Iterator[Ioc]:
    with alone(), Ioc() as started:
        yield started


def epics(**more: Any) -> dict[str, Any]:
    return {"kind": "epics", **NAMES, **PROVEN, "patience": 10.0, **more}


def moved(connection: dict[str, Any], **more: Any) -> Run:
    return executed(hybrid(station(1, connection, **more), station(2), duration=0.3))


@pytest.mark.parametrize("reading", ["get", "monitor"])
def test_a_rig_behind_process_variables_gives_the_response_of_its_model(ioc: Ioc, reading: str) -> None:
    ioc.fails()
    run = moved(epics(reading=reading))
    assert run.trip is None
    assert np.allclose(run.signals, emulated(run.plan).signals, rtol=1e-9, atol=1e-9)
    assert np.abs(run.signals[:, [one.key for one in run.channels].index("x_meas.1")]).max() > 1e-3


def test_without_an_echo_readings_can_belong_to_commands_before(ioc: Ioc) -> None:
    """The put completes when the record is processed; the rig's own handler may run later."""
    ioc.fails()
    run = moved(epics(echo=""))
    keys = [one.key for one in run.channels]
    x_comp, x_meas = run.signals[:, keys.index("x_comp.1")], run.signals[:, keys.index("x_meas.1")]
    sent = np.concatenate([[0.0], x_comp])
    assert run.trip is None and all(np.abs(sent[: q + 2] - x).min() < 1e-12 for q, x in enumerate(x_meas))


@pytest.mark.parametrize(
    ("fault", "what"),
    [
        ("invalid", "RIG:F has an alarm: its value is INVALID"),
        ("withdraw", "it withdrew its permit (RIG:PERMIT)"),
        ("silent", "it did not answer within 0.3 s"),
    ],
)
def test_a_rig_that_fails_ends_the_test_with_what_was_recorded(ioc: Ioc, fault: str, what: str) -> None:
    ioc.fails(fault, 20)
    run = moved(epics(patience=0.3))
    assert isinstance(run.trip, Stop) and run.done in (19, 20)  # the permit may arrive after the readings
    assert f"Station 1 (Spring 1) lost its rig, EPICS record RIG:CMD: {what}." in run.trip.sentence


@pytest.mark.parametrize(
    ("more", "where", "problem"),
    [
        ({"displacement_unit": "m"}, "command", "is in mm (EGU), but the plan gives m"),
        ({"displacement": "RIG:FEET"}, "displacement", "is in ft (EGU), but the plan gives mm"),
        ({"force_unit": "N"}, "force", "is in kN (EGU), but the plan gives N"),
        ({"limits": {"displacement": 0.1, "velocity": 2.0}}, "command", "takes -50 to 50 mm (DRVL, DRVH)"),
    ],
)
def test_a_record_that_contradicts_the_plan_is_refused(ioc: Ioc, more: dict[str, Any], where: str, problem: str) -> None:
    ioc.fails()
    limits = {"limits": more.pop("limits")} if "limits" in more else {}
    with pytest.raises(RigError) as refused:
        moved(epics(**more), **limits)
    assert refused.value.issues[0].where == f"stations.0.connection.{where}" and problem in str(refused.value)


def test_a_rig_without_permit_is_refused(ioc: Ioc) -> None:
    ioc.fails("forbid")
    with pytest.raises(RigError, match="does not permit a test"):
        moved(epics())


def test_a_variable_that_no_ioc_serves_is_named(ioc: Ioc, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rths_engine.parts.connections.epics_channels.OPENING_S", 0.5)
    ioc.fails()
    with pytest.raises(RigError, match=r"connection\.force = RIG:FORCE: no IOC answers within 0\.5 s"):
        moved(epics(force="RIG:FORCE"))


def test_an_ioc_that_ends_during_a_test_ends_the_test(ioc: Ioc) -> None:
    ioc.fails("end", 20)
    run = moved(epics(patience=5.0))
    assert isinstance(run.trip, Stop) and run.done == 19
    assert "is disconnected" in run.trip.sentence or "did not answer" in run.trip.sentence
