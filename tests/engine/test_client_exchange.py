"""What a rig does with the messages of a client, by a client written from the protocol."""

from __future__ import annotations

import socket
from time import perf_counter
from typing import Any

import numpy as np
import pytest

from rths_engine.client.session import Session, listening
from rths_engine.foundation.errors import PlanError
from rths_engine.planning.reading import read_plan
from rths_engine.planning.templates import template
from rths_engine.running.client_run import ClientRun
from rths_engine.running.run import simulate
from rths_engine.wire.generic import Action, Numbers, Sizes
from tests.engine.clients import DAMPING, RATE, STIFFNESS, Generic, ended, led, served, station

DT = 1 / RATE
STEP = 0.01


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
