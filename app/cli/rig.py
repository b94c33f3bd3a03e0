"""`rths rig`: let another program, such as OpenSees, drive the rig of a plan, without a server."""

from __future__ import annotations

import json
import sys
import time
from argparse import Namespace

from tqdm import tqdm

from app.cli.main import DONE, FAILED, INTERRUPTED
from app.cli.result import text
from app.cli.run import Interrupt
from app.cli.run_input import check_folder, model_of_plan
from rths_engine.client.session import Session, listening
from rths_engine.client.words import lines, warning
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.recordings.run_file import save
from rths_engine.running.client_run import ClientRun
from rths_engine.running.warm import warm

LEAVING_S = 10.0  # longest wait for the client to leave after the end of the test


def rig(given: Namespace) -> int:
    """`rths rig`: serve one client. Exit code: 0 completed or tripped, 1 nothing recorded, 2 invalid input, 130 interrupted."""
    model = _model(given)
    if given.out:
        check_folder(given.out)
    run = ClientRun(model)
    warm()
    listener = listening(run, given.host)
    with Interrupt() as interrupt, Shown(run, interrupt, given.host) as shown:
        session = Session(run, listener, shown)
        session.serve()
    elapsed_s = shown.elapsed_s
    if session.farewell is not None:
        session.farewell.wait(LEAVING_S)
    if run.empty:
        return _nothing(session, given.json)
    status = "cancelled" if session.cancelled else "tripped" if run.trip else "completed"
    result = run.result(status, elapsed_s)
    try:
        if given.out:
            save(given.out, result)
    except OSError as error:
        print(f"rths rig: the recording was not stored: {error}", file=sys.stderr)
        return FAILED
    summary = result.summary()
    print(json.dumps(summary) if given.json else text(run.plan, summary, given.out))
    return INTERRUPTED if session.cancelled else DONE


class Shown:
    """Shows a test with a client on the terminal, and stops it at Ctrl-C."""

    def __init__(self, run: ClientRun, interrupt: Interrupt, host: str):
        self.run, self.interrupt, self.host = run, interrupt, host
        self.elapsed_s = 0.0
        self._begun: float | None = None
        self._bar = tqdm(bar_format="{n:.1f} s tested in {elapsed}", leave=False, disable=None)

    def __enter__(self) -> Shown:
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.close()
        if self._begun is not None:
            self.elapsed_s = time.perf_counter() - self._begun

    def waiting(self, address: str) -> None:
        """Tell where the rig listens, and what to put into the script of the client."""
        plan: Plan = self.run.plan
        for one in (
            warning(self.host),
            f"Waiting for a client at {address} by {plan.client.transport.upper()}. In its script:",
            *(f"  {name}: {line}" for name, line in lines(plan, self.host, int(address.rpartition(":")[2])).items()),
        ):
            if one:
                print(one, file=sys.stderr, flush=True)

    def connected(self, peer: str) -> None:
        """Tell that a client has connected."""
        self._begun = time.perf_counter()
        print(f"Client connected from {peer}.", file=sys.stderr, flush=True)

    def shown(self) -> bool:
        """Show the simulated time; returns whether Ctrl-C was pressed."""
        self._bar.update(self.run.done * self.run.dt - self._bar.n)
        return self.interrupt.asked


def _model(given: Namespace) -> Model:
    model = model_of_plan(given.plan)
    plan = model.plan
    if plan.test != "client":
        fix = "set test: client and remove structure, motion and integrator; docs/opensees-rig.md has a plan"
        raise PlanError(Issue("test", "is not a test with a client", plan.test, fix))
    changed = {"port": given.listen} if given.listen is not None else {}
    if given.listen is not None and not 0 <= given.listen <= 65_535:
        raise PlanError(Issue("--listen", "is not a port: needs 0 to 65535", given.listen, "0 takes any free port"))
    return model.changed(client=plan.client.model_copy(update=changed | ({"transport": "udp"} if given.udp else {})))


def _nothing(session: Session, as_json: bool) -> int:
    """The end of a test in which the rig never moved."""
    if session.cancelled:
        return INTERRUPTED
    ended = session.told()["ended"]
    print(f"rths rig: nothing was recorded. {ended}", file=sys.stderr)
    if as_json:
        print(json.dumps({"status": "failed", "errors": [Issue("", ended).as_dict()]}))
    return FAILED
