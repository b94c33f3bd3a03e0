"""What a rig does with the messages of a client, good and bad, by a client written from the protocol."""

from __future__ import annotations

import contextlib
import math
import socket
import struct
import threading
from collections.abc import Callable
from time import perf_counter, sleep
from typing import Any

import numpy as np
import pytest

from rths_engine.client.session import Session, listening
from rths_engine.foundation.errors import PlanError
from rths_engine.planning.reading import read_plan
from rths_engine.planning.safety import Stop
from rths_engine.planning.templates import template
from rths_engine.running.client_run import ClientRun
from rths_engine.running.run import simulate
from rths_engine.wire.generic import Action, Numbers, Sizes
from tests.engine.clients import DAMPING, RATE, STIFFNESS, Generic, led, served, station

DT = 1 / RATE
STEP = 0.01


def ended(session: Session) -> str:
    """The sentence of a session that stopped its test for another reason than a limit."""
    assert isinstance(session.run.trip, Stop)
    return session.run.trip.sentence


@pytest.mark.parametrize("transport", ["tcp", "udp"])
def test_the_command_ramps_between_the_steps_and_the_force_is_that_at_the_end_of_the_ramp(transport: str) -> None:
    forces: list[float] = []

    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        forces.extend(peer.step(x, t) for x, t in ((0.001, 0.01), (0.003, 0.03)))
        peer.end()

    session = served(led(client={"transport": transport}), client)
    run = session.run
    x = np.concatenate([np.linspace(0, 0.001, 11)[1:], 0.001 + np.linspace(0, 0.002, 21)[1:]])
    assert run.done == 30 and run.signals[:30, 0] == pytest.approx(x, abs=1e-15)
    velocity = 0.1  # m/s in both ramps, of an ideal actuator
    assert forces == pytest.approx([STIFFNESS * 0.001 + DAMPING * velocity, STIFFNESS * 0.003 + DAMPING * velocity], rel=1e-9)
    assert run.trip is None and session.told()["ended"] == "The client ended the test."
    assert session.told()["steps"] == 2 and not session.told()["warnings"]


def test_a_run_of_a_client_that_sends_a_drive_equals_the_run_of_that_drive_to_the_bit() -> None:
    values = [0.0, 0.1, 0.3, 0.2, -0.1]
    noisy = station(noise={"displacement": 1e-5, "force": 100.0}, actuator={"kind": "first_order_delay", "alpha": 8.0})

    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        for k, value in enumerate(values[1:], start=1):
            peer.step(0.001 * value, k * DT)  # every step of the client is one controller step
        peer.end()

    session = served(led([noisy], seed=5), client)
    drive = {"amplitude": 0.001, "shape": {"kind": "samples", "dt": DT, "values": values}}
    own = led([noisy], seed=5).model_dump(mode="json", by_alias=True) | {"test": "specimen", "drive": drive, "duration": 4 * DT}
    del own["client"]
    other = simulate(read_plan(own))
    assert np.array_equal(session.run.signals[:4], other.signals)


def test_two_degrees_of_freedom_are_two_stations_in_their_order() -> None:
    found: dict[str, Any] = {}

    def client(session: Session) -> None:
        peer = Generic(session, count=2)
        peer.say(Action.SET_TRIAL, (0.0, 0.0), 0.0)
        peer.say(Action.SET_TRIAL, (0.001, -0.002), STEP)
        found["force"] = peer.ask(Action.FORCE, 2)
        found["x"], found["v"] = peer.ask(Action.DISPLACEMENT, 2), peer.ask(Action.VELOCITY, 2)
        found["a"], found["t"] = peer.ask(Action.ACCELERATION, 2), peer.ask(Action.TIME, 1)
        found["k"], found["c"] = peer.ask(Action.TANGENT_STIFFNESS, 4), peer.ask(Action.DAMPING, 4)
        found["m"] = peer.ask(Action.MASS, 4)
        peer.end()

    soft = station("Soft", specimen={"kind": "linear", "stiffness": 0.0, "damping": DAMPING}, equivalent_stiffness=2.0e5)
    served(led([station(equivalent_stiffness=STIFFNESS), soft]), client)
    assert found["force"] == pytest.approx((STIFFNESS * 0.001 + DAMPING * 0.1, -DAMPING * 0.2), rel=1e-9)
    assert found["x"] == (0.001, -0.002) and found["t"] == (STEP,)
    assert found["v"] == pytest.approx((0.1, -0.2)) and found["a"] == pytest.approx((0.0, 0.0), abs=1e-6)
    assert found["k"] == (STIFFNESS, 0.0, 0.0, 2.0e5)
    assert found["c"] == (0.0,) * 4 == found["m"]  # the measured force contains damping and inertia already


def test_a_step_without_new_displacement_holds_the_rig_and_a_large_message_is_cut_into_datagrams() -> None:
    def client(session: Session) -> None:
        peer = Generic(session, size=3000)
        for k in range(4):
            peer.say(Action.SET_TRIAL, (0.0,), k * STEP)
            assert peer.ask(Action.FORCE, 1) == (0.0,)
            peer.say(Action.COMMIT)
        peer.end()

    session = served(led(client={"transport": "udp"}), client)
    assert session.run.done == 30 and not session.run.signals[:30].any() and session.told()["steps"] == 3


def test_a_client_that_sends_a_second_displacement_within_a_step_is_warned_and_the_rig_stays_at_the_first() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        for k, x in ((1, 0.001), (2, 0.002)):
            peer.say(Action.SET_TRIAL, (0.0011 if k == 2 else 0.0,), k * STEP)  # repeats the last displacement
            peer.say(Action.SET_TRIAL, (x,), k * STEP)
            peer.say(Action.SET_TRIAL, (x + 0.0001,), k * STEP)
            assert peer.ask(Action.DISPLACEMENT, 1)[0] == x
            peer.say(Action.COMMIT)
        peer.end()

    told = served(led(), client).told()
    assert told["iterations"] == 2 and told["unfollowed_m"] == pytest.approx(1e-4)
    assert len(told["warnings"]) == 1 and "NewmarkExplicit" in told["warnings"][0]


def test_steps_that_are_no_multiple_of_the_controller_step_are_followed_and_reported() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        for k in range(1, 5):
            peer.step(0.0001 * k, k * 0.01024)
        peer.end()

    session = served(led(), client)
    assert session.run.done == round(4 * 10.24)
    assert "10.24 of them" in session.told()["warnings"][0] and "Choose a step of 0.01 s" in session.told()["warnings"][0]


def test_a_client_whose_time_starts_again_at_zero_goes_on_from_there() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        peer.step(0.0005, 0.02)
        peer.step(0.001, 0.01)  # as after `loadConst -time 0.0`
        peer.end()

    session = served(led(), client)
    assert session.run.done == 30 and "set its time back" in session.told()["warnings"][0]


def test_a_time_that_runs_back_by_less_than_to_zero_ends_the_test() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        for k in range(1, 5):
            peer.step(0.0001 * k, 0.05 * k)
        peer.say(Action.SET_TRIAL, (0.0003,), 0.1)
        peer.end()

    session = served(led(), client)
    assert session.run.done == 200 and "set its time back from 0.2 s to 0.1 s" in ended(session)


def test_a_client_that_reads_everything_at_once_needs_no_commit_as_openfresco_has_none() -> None:
    """The messages of OpenFresco's ECGenericTCP with disp control, disp and force daq modes: 3, 6, ..., 99, and no time."""
    found: list[tuple[float, ...]] = []

    def client(session: Session) -> None:
        peer = Generic(session, sizes=Sizes(Numbers(1), Numbers(displacement=1, force=1), 256))
        for x in (0.0, 0.001, 0.001, 0.003):
            peer.say(Action.SET_TRIAL, (x,))
            found.append(peer.ask(Action.DATA, 2))
        peer.end()

    session = served(led(client={"step": STEP}), client)
    assert session.run.done == 20 and session.told()["steps"] == 2
    first, last = (0.001, STIFFNESS * 0.001 + DAMPING * 0.1), (0.003, STIFFNESS * 0.003 + DAMPING * 0.2)
    assert np.array(found) == pytest.approx(np.array([(0.0, 0.0), first, first, last]), rel=1e-9)


def test_a_client_that_sends_displacements_with_the_time_before_needs_its_step_in_the_plan() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        for k in range(3):  # as CentralDifference does
            peer.say(Action.SET_TRIAL, (0.001 * k,), k * STEP)
            peer.say(Action.SET_TRIAL, (0.001 * (k + 1),), k * STEP)
            peer.say(Action.COMMIT)
        peer.end()

    session = served(led(client={"step": STEP}), client)
    assert (
        session.run.done == 30 and session.run.signals[29, 0] == 0.003 and "CentralDifference" in session.told()["warnings"][0]
    )

    def early(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.001,), 0.0)
        peer.end()

    refused = served(led(), early)
    assert "client.step" in ended(refused) and refused.run.done == 0


Bad = Callable[[Generic], None]
BAD: dict[str, tuple[Bad, str]] = {
    "a displacement that is not a number": (lambda peer: peer.say(3, (math.nan,), 0.02), "not a number after 0.01 s"),
    "an infinite time": (lambda peer: peer.say(3, (0.0,), math.inf), "not a number after 0.01 s"),
    "an unknown action": (lambda peer: peer.say(42), "the action code 42"),
    "a code that is not a number": (lambda peer: peer.say(math.nan), "the action code nan"),  # type: ignore[arg-type]
    "a missing commit": (lambda peer: peer.all((3, (0.001,), 0.02), (3, (0.001,), 0.03)), "commit is missing"),
    "a time before the last": (lambda peer: peer.say(3, (0.001,), -1.0), "set its time back from 0.01 s to -1 s"),
    "an endless step": (lambda peer: peer.say(3, (0.001,), 1e300), "beyond the longest duration of 600 s"),
    "a vanished client": (lambda peer: peer.socket.close(), "closed the connection without its last message"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_message_ends_the_test_safely_with_what_was_recorded(case: str) -> None:
    act, words = BAD[case]

    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        peer.step(0.0001, 0.01)
        act(peer)
        if case != "a vanished client":
            for _ in range(3):  # the rig answers NaN until the client leaves, so that it does not wait forever
                assert math.isnan(peer.ask(Action.FORCE, 1)[0])
            peer.end()

    session = served(led(), client)
    assert words in ended(session) and ended(session).startswith("Stopped at 0.0")
    assert session.run.done >= 10 and session.run.signals[9, 0] == 0.0001
    assert session.run.result("tripped", 0.0).summary()["client"]["ended"] == ended(session)
    assert session.farewell is None or session.farewell.wait(60)


def test_a_jump_beyond_the_limits_trips_in_its_controller_step() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        peer.step(0.0001, 0.01)
        assert math.isnan(peer.step(0.05, 0.02))
        peer.end()

    session = served(led(), client)
    trip = session.run.trip
    assert trip is not None and (trip.limit, trip.station, trip.substep) == ("velocity", 1, 11) and session.run.done == 10


def test_a_jump_in_the_first_controller_step_is_a_trip_without_a_record() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        peer.say(Action.SET_TRIAL, (1e300,), 0.01)
        peer.end()

    run = served(led(), client).run
    assert run.done == 0 and run.trip is not None and not run.empty
    assert "was 1e+302 mm, beyond its limit of 100 mm" in run.trip.sentence
    summary = run.result("tripped", 0.1).summary()
    assert summary["trip"]["limit"] == "displacement" and summary["simulated_s"] == 0


@pytest.mark.parametrize(("first", "words"), [(1e308, "begins at 1e+308 s"), (-1e308, "begins at -1e+308 s")])
def test_a_first_time_too_large_for_controller_steps_is_refused(first: float, words: str) -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), first)
        peer.end()

    assert words in ended(served(led(), client))


def _packed(*numbers: float) -> bytes:
    return struct.pack("<16d", *numbers, *[0.0] * (16 - len(numbers)))


REPEATED = _packed(Action.SET_TRIAL, 0.0001, 0.0, 0.0, 0.01)
CHATTER = {
    "a displacement and a question again and again": REPEATED + _packed(Action.FORCE),
    "a question again and again": _packed(Action.FORCE),
    "a code without answer again and again": _packed(Action.EXECUTE),
    "one byte at a time": b"\0",
}


@pytest.mark.parametrize("case", CHATTER)
def test_a_stop_is_heard_whatever_the_client_sends(case: str) -> None:
    data = CHATTER[case]
    stop, heard = threading.Event(), threading.Event()

    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        peer.step(0.0001, 0.01)
        stop.set()
        with contextlib.suppress(OSError):
            while not heard.wait(0.02 if len(data) == 1 else 0.0):
                peer.socket.send(data)
                if "question" in case:
                    peer.socket.recv(65_536)
        peer.socket.close()

    def until() -> bool:
        if stop.is_set():
            heard.set()
        return heard.is_set()

    session = served(led(), client, until)
    assert session.cancelled and session.run.done == 10


@pytest.mark.parametrize("transport", ["tcp", "udp"])
def test_the_patience_is_that_for_a_whole_message(transport: str) -> None:
    def client(session: Session) -> None:
        peer = Generic(session, size=4000)
        peer.socket.send(b"\0" * 9126)
        while not session.run.finished:
            sleep(0.02)
            if not peer.udp:
                peer.socket.send(b"\0")
        peer.socket.close()

    plan = led(client={"transport": transport, "patience": 0.3})
    session = served(plan, client)
    assert "of the 32000 bytes of a message within 0.3 s" in ended(session)


HEADERS = {
    "three degrees of freedom for one station": ((3, 3, 3, 0, 1, 0, 0, 0, 3, 0, 256), "3 basic degrees of freedom"),
    "no displacement": ((0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 256), "sends no displacements"),
    "two forces for one degree of freedom": ((1, 1, 1, 0, 1, 0, 0, 0, 2, 0, 256), "reads 2 forces"),
    "messages that are too small": ((1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 4), "needs 5"),
    "no setup message": ((1836016416,) * 11, "not a setup message"),
    "negative counts": ((1, 1, 1, 0, 1, 0, 0, 0, -1, 0, 256), "not a setup message"),
}


@pytest.mark.parametrize("case", HEADERS)
def test_a_setup_message_that_the_rig_cannot_serve_ends_the_test(case: str) -> None:
    numbers, words = HEADERS[case]
    session = served(led(), lambda session: _header(session, struct.pack("<11i", *numbers)))
    assert words in ended(session) and session.run.done == 0


def test_a_client_with_the_other_byte_order_is_recognised() -> None:
    session = served(led(), lambda session: _header(session, struct.pack(">11i", 1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 256)))
    assert "big-endian" in ended(session)


def _header(session: Session, header: bytes) -> None:
    host, _, port = session.address.rpartition(":")
    with socket.create_connection((host, int(port))) as peer:
        peer.sendall(header)
        peer.settimeout(60)
        assert peer.recv(16) == b""  # the rig closes the connection


def test_a_second_client_is_refused_while_the_first_is_served() -> None:
    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        assert peer.ask(Action.FORCE, 1) == (0.0,)
        host, _, port = session.address.rpartition(":")
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection((host, int(port)))
        peer.end()

    assert served(led(), client).run.trip is None


def test_a_silent_client_a_client_that_never_comes_and_a_stop_by_people_end_the_test() -> None:
    peers: list[Generic] = []
    silent = served(led(client={"patience": 0.1}), lambda session: peers.append(Generic(session)))
    peers[0].socket.close()
    assert "silent for 0.1 s" in ended(silent)
    absent = served(led(client={"waiting": 0.1}), lambda session: None)
    assert "No client connected" in ended(absent)
    stopped = served(led(), lambda session: None, until=lambda: True)
    assert stopped.cancelled and stopped.run.trip is None and stopped.run.finished


def test_in_real_time_the_force_comes_when_the_rig_has_reached_the_displacement() -> None:
    times: list[float] = []

    def client(session: Session) -> None:
        peer = Generic(session)
        peer.say(Action.SET_TRIAL, (0.0,), 0.0)
        for k in range(1, 4):
            begun = perf_counter()
            peer.step(0.0001 * k, k * 0.02)
            times.append(perf_counter() - begun)
        peer.end()

    session = served(led(pace={"kind": "real_time"}), client)
    assert session.run.done == 60 and min(times) > 0.019  # a ramp takes 0.02 s or longer, never shorter


def test_a_port_that_is_taken_is_reported() -> None:
    refused = pytest.raises(PlanError, match=r"client.port = \d+: cannot be opened at 127.0.0.1")
    with socket.create_server(("127.0.0.1", 0)) as taken, refused:
        listening(ClientRun(led(client={"port": taken.getsockname()[1]})), "127.0.0.1")


def test_how_the_client_is_reached_does_not_change_the_digest_but_its_step_does() -> None:
    assert led().digest == led(client={"port": 9000, "transport": "udp"}).digest != led(client={"step": 0.01}).digest
    with pytest.raises(PlanError, match="used only in tests with a client"):
        read_plan(template("linear-damper").model_dump(mode="json", by_alias=True) | {"client": {"port": 1}})


def test_recorded_arrays_grow_with_the_test(monkeypatch: pytest.MonkeyPatch) -> None:
    noisy = [station(noise={"displacement": 1e-6, "force": 10.0})]
    whole = ClientRun(led(noisy))
    monkeypatch.setattr("rths_engine.running.client_run.FIRST_ROWS", 7)
    grown = ClientRun(led(noisy))
    for run in (whole, grown):
        for target in (0.001, 0.002, 0.0):
            run.ramp((target,), 20)
            run.advance(20)
    assert len(grown.signals) < 200 and np.array_equal(whole.signals[:60], grown.signals[:60])


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"stations": []}, "at least one station"),
        (
            {"structure": {"kind": "shear_building", "storeys": [{"mass": 1e5, "stiffness": 1e7}]}},
            "a test with a client follows",
        ),
        ({"drive": {"amplitude": 0.01, "shape": {"kind": "sine"}}}, "only in tests of a specimen"),
        ({"stations": [station(connection={"kind": "generic_client"})]}, "a client moves emulated stations only"),
        ({"stations": [station(dampers=2)]}, "dampers = 2: is not used"),
    ],
)
def test_a_plan_that_a_client_cannot_drive_is_refused(changed: dict[str, Any], words: str) -> None:
    with pytest.raises(PlanError, match=words):
        read_plan(led().model_dump(mode="json", by_alias=True) | changed)
