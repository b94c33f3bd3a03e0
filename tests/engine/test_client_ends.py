"""Every end of a test with a client: bad messages, limits, patience, stops and other clients, with what was recorded."""

from __future__ import annotations

import contextlib
import math
import socket
import struct
import threading
from collections.abc import Callable
from time import sleep

import pytest

from rths_engine.client.session import Session
from rths_engine.wire.generic import Action
from tests.engine.clients import RATE, Generic, ended, led, served

DT = 1 / RATE
STEP = 0.01


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
