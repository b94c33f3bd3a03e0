"""The engine as the client of a rig server that speaks the generic protocol."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

from rths_engine.client.session import Session
from rths_engine.foundation.errors import PlanError
from rths_engine.parts.connections.connection import RigError
from rths_engine.planning.plan import RealTime
from rths_engine.planning.reading import read_plan
from rths_engine.planning.safety import Stop, Trip
from rths_engine.running.opening import opened
from rths_engine.running.paced import PacedRun
from rths_engine.running.run import Run
from rths_engine.running.step_clock import StepClock
from rths_engine.wire.generic import Action
from tests.engine.clients import led, served
from tests.engine.external_plans import RATE, emulated, executed, hybrid, station
from tests.engine.generic_server import serving
from tests.engine.plans import LIBRARY


def generic(port: int, **more: Any) -> dict[str, Any]:
    return {"kind": "generic_client", "port": port, **more}


@pytest.mark.parametrize(("transport", "size"), [("tcp", 256), ("udp", 2000)])
def test_a_rig_server_beside_an_emulated_station_gives_the_response_of_its_model(transport: str, size: int) -> None:
    with serving(2.0, udp=transport == "udp") as server:
        plan = hybrid(station(1, generic(server.port, transport=transport, size=size)), station(2))
        run = executed(plan)
    model = emulated(plan)
    assert run.trip is None and run.done == run.total
    scale = np.maximum(np.abs(model.signals).max(axis=0), 1e-3)
    assert np.all(np.abs(run.signals - model.signals) <= 1e-9 * scale)  # mm and kN on the wire round the last places
    assert server.asked[:2] == [Action.DISPLACEMENT, Action.FORCE], "the rig is read before it moves"
    assert server.asked[2:7] == [Action.SET_TRIAL, Action.SET_TRIAL, Action.DISPLACEMENT, Action.FORCE, Action.COMMIT]
    assert (server.trials[0].time, server.trials[0].displacement) == (0.0, (0.0,))


def test_signs_and_units_of_the_rig_are_converted_and_the_end_holds_the_last_displacement() -> None:
    with serving(-2000.0 / 1000 * 1000, ends={}) as server:  # N/mm, with forces counted in the opposite direction
        plan = hybrid(station(1, generic(server.port, force_unit="N", force_reversed=True)))
        run = executed(plan)
    assert np.allclose(run.signals, emulated(plan).signals, rtol=1e-9, atol=1e-9)
    last = run.signals[-1, [channel.key for channel in run.channels].index("x_comp.1")] * 1e3
    hold = server.trials[-1]
    assert hold.displacement[0] == pytest.approx(last) and hold.velocity[0] == hold.acceleration[0] == 0.0
    assert server.asked[-2:] == [Action.SET_TRIAL, Action.END]
    times = [trial.time for trial in server.trials[:-1]]
    assert np.allclose(times, np.arange(run.total + 1) * run.dt)


def test_the_rig_of_this_program_follows_the_engine_and_both_record_the_same() -> None:
    """`rths rig` as the peer: its own loop, actuator and specimen behind the protocol."""
    rig = led([{**station(1), "storey": 1, "connection": {"kind": "emulated"}}], controller_rate=RATE, duration=1.0)
    runs = []

    def engine(session: Session) -> None:
        port = int(session.address.rpartition(":")[2])
        runs.append(executed(hybrid(station(1, generic(port, displacement_unit="m", force_unit="N")), station(2))))

    session = served(rig, engine)
    (run,) = runs
    assert run.trip is None and session.run.trip is None and session.told()["ended"] == "The client ended the test."
    assert np.allclose(run.signals, emulated(run.plan).signals, rtol=1e-9, atol=1e-9)
    own, theirs = [one.key for one in run.channels], [one.key for one in session.run.channels]
    assert session.run.done == run.done
    for key in ("x_meas.1", "f_meas.1"):
        assert np.array_equal(session.run.signals[: run.done, theirs.index(key)], run.signals[:, own.index(key)])
    told = session.told()
    assert (told["steps"], told["iterations"], told["warnings"]) == (run.done, 0, [])


@pytest.mark.parametrize(
    ("ends", "what"),
    [
        ("vanish", "it closed the connection"),
        ("silent", "it did not answer within 1 s"),
        ("trickle", "it did not answer within 1 s"),
        ("nan", "it sent a force that is not a number"),
    ],
)
def test_a_lost_rig_ends_the_test_with_what_was_recorded(ends: str, what: str) -> None:
    with serving(2.0, ends={41: ends}) as server:
        run = executed(hybrid(station(1), station(2, generic(server.port, patience=1.0))))
    stop = run.trip
    assert isinstance(stop, Stop) and run.done == 39
    assert stop.sentence == (
        f"Stopped at {39 / 256:.3f} s. Station 2 (Spring 2) lost its rig, "
        f"generic server 127.0.0.1:{server.port} (TCP): {what}. "
        f"The last good measurement is that of {39 / 256:.3f} s."
    )
    result = run.result("tripped", 0.1)
    assert result.summary()["trip"]["sentence"] == stop.sentence and len(result.signals) == 39
    if ends in ("silent", "nan"):
        assert server.asked[-2:] == [Action.SET_TRIAL, Action.END], "the rig holds its last displacement"
        assert server.trials[-1].displacement == server.trials[-2].displacement


def test_a_command_beyond_its_limit_is_never_sent() -> None:
    limits = {"displacement": 0.002, "velocity": 2.0, "force": 5e5}
    with serving(2.0) as server:
        run = executed(hybrid(station(1, generic(server.port), limits=limits)))
    assert isinstance(run.trip, Trip) and run.trip.limit == "displacement"
    assert max(abs(trial.displacement[0]) for trial in server.trials) <= 2.0
    assert len(server.trials) == run.done + 2 and server.asked[-1] == Action.END  # the first one is zero, the last one holds


def test_a_compensated_command_beyond_the_limit_is_never_sent() -> None:
    lead = {"kind": "inverse", "alpha_es": 200.0}
    with serving(2.0) as server:
        run = executed(hybrid(station(1, generic(server.port), compensator=lead)))
    assert isinstance(run.trip, Trip) and run.trip.limit == "displacement" and run.trip.bound == 0.03
    assert max(abs(trial.displacement[0]) for trial in server.trials) <= 30.0


def test_a_force_beyond_its_limit_ends_the_test_and_the_rig_holds() -> None:
    limits = {"displacement": 0.03, "velocity": 2.0, "force": 4e3}
    with serving(2.0) as server:
        run = executed(hybrid(station(1, generic(server.port), limits=limits)))
    assert isinstance(run.trip, Trip) and run.trip.limit == "force"
    assert server.asked[-2:] == [Action.SET_TRIAL, Action.END]


def test_a_rig_that_stands_away_from_zero_is_refused_before_it_moves() -> None:
    with serving(2.0, at=12.5) as server, pytest.raises(RigError) as refused:
        executed(hybrid(station(1, generic(server.port))))
    assert "stands at 12.5 mm" in str(refused.value) and refused.value.issues[0].where.endswith("connection.start_within")
    assert Action.SET_TRIAL not in server.asked and server.asked[-1] == Action.END


def test_a_server_that_is_not_there_is_named_with_its_address() -> None:
    with serving(2.0) as server:
        port = server.port
        executed(hybrid(station(1, generic(port)), duration=0.1))
    with pytest.raises(RigError, match=rf"the generic server 127.0.0.1:{port} \(TCP\) does not answer: Connection refused"):
        executed(hybrid(station(1, generic(port))))


@pytest.mark.parametrize("host", ["a..b", "a" * 250])
def test_a_host_that_cannot_be_a_name_is_refused_with_its_field(host: str) -> None:
    with pytest.raises(RigError, match="cannot be the name of a computer") as refused:
        executed(hybrid(station(1, generic(8090, host=host))))
    (issue,) = refused.value.issues
    assert issue.where == "stations.0.connection.host" and issue.value == host


def test_plans_that_would_move_a_rig_wrongly_are_refused() -> None:
    one, two = station(1, generic(8090)), station(2, generic(8090))
    with pytest.raises(PlanError, match="is also the rig of station 1"):
        hybrid(one, two)
    with pytest.raises(PlanError, match="has no clock that the rig of station 1"):
        hybrid(one, pace={"kind": "fastest"})
    current = {"controller": {"kind": "constant", "current": 1.0}}
    with pytest.raises(PlanError, match="has no place for the current"):
        hybrid(station(1, generic(8090), **current))


def test_a_client_cannot_drive_an_external_rig() -> None:
    """Another program's displacements would pass through two servers, whose delays nobody compensates."""
    one = {key: value for key, value in station(1, generic(8090)).items() if key != "storey"}
    with pytest.raises(PlanError, match="which a test with a client cannot drive"):
        read_plan({"test": "client", "controller_rate": 256.0, "stations": [one], "pace": {"kind": "real_time"}})


def test_an_external_station_never_runs_on_its_model_by_accident() -> None:
    plan = hybrid(station(1, generic(8090)))
    with pytest.raises(PlanError, match=r"stations\.0\.connection: is an external rig"):
        Run(plan, LIBRARY)


def test_a_test_in_real_time_measures_its_steps_and_never_runs_ahead_of_its_clock() -> None:
    with serving(2.0) as server:
        plan = hybrid(station(1, generic(server.port)), pace={"kind": "real_time", "factor": 1.0}, duration=0.25)
        begun = time.perf_counter()
        with opened(plan, LIBRARY) as run:
            assert isinstance(plan.pace, RealTime)
            paced = PacedRun(run, plan.pace)
            paced.start()
            while not paced.take(0.01):
                pass
        taken = time.perf_counter() - begun
    assert run.done == run.total and taken >= (run.total - 1) * run.dt
    assert np.allclose(run.signals, emulated(plan).signals, rtol=1e-9, atol=1e-9)
    timing = run.result("completed", taken).summary()["timing"]
    assert (timing["steps"], timing["rate_hz"]) == (run.total, RATE) and timing["worst"]["share"] > 0


@pytest.mark.parametrize("ends", [{}, {41: "silent"}])
def test_a_paced_test_that_is_stopped_or_loses_its_rig_ends_safely(ends: dict[int, str]) -> None:
    with serving(2.0, ends=ends) as server:
        plan = hybrid(station(1, generic(server.port, patience=1.0)), pace={"kind": "real_time", "factor": 0.5}, duration=5.0)
        with opened(plan, LIBRARY) as run:
            assert isinstance(plan.pace, RealTime)
            paced = PacedRun(run, plan.pace)
            paced.start()
            while len(server.trials) < 30:
                time.sleep(0.01)
            if not ends:
                paced.stop()
            while not paced.take(0.01):
                pass
    assert run.done < run.total and (run.trip is not None) is bool(ends)
    assert run.timing is not None and len(run.timing.delays) == run.done
    assert server.asked[-2:] == [Action.SET_TRIAL, Action.END]


def test_a_late_step_is_measured_and_the_lost_time_is_never_caught_up() -> None:
    delays, lengths = np.zeros((2, 3), dtype=np.float32)
    clock = StepClock(0.01, delays, lengths)
    begun = []
    for step in range(3):
        clock.wait()
        begun.append(clock.begun)
        clock.end(step)
        if step == 0:
            time.sleep(0.05)
    assert begun[2] - begun[1] >= 0.01 - 1e-9
    assert delays[1] >= 3.9e7, "late by 50 ms, less the period and what the first wait took"
