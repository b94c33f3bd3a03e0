"""A test with a client: another program computes the structure, and the engine process serves it a rig."""

from __future__ import annotations

import time
from typing import Any

from app.runs.order import WAITING, Outcome, RunOrder
from app.worker.child import Line, Refused
from app.worker.room import room_for
from app.worker.viewers import Viewers

PROGRESS_S = 0.1
RECENT = 1000  # steps of the client whose times are shown live


def execute(order: RunOrder, line: Line) -> Outcome:
    """Serve the client of a test and save its recording. Raises Refused where the rig never moved."""
    from rths_engine.client.session import Session, listening
    from rths_engine.foundation.errors import RthsError
    from rths_engine.planning.reading import read_model
    from rths_engine.recordings.run_file import save
    from rths_engine.running.client_run import ClientRun

    try:
        run = ClientRun(read_model(order.plan))
        listener = listening(run, order.settings.rig_host)
    except RthsError as error:
        raise Refused(str(error)) from None
    shown = Shown(run, order, line)
    session = Session(run, listener, shown)
    shown.session = session
    with room_for(run, order.recording) as release:
        session.serve()
        if session.cancelled:
            line.stopping()
        if run.empty and not session.cancelled:
            raise Refused(f"Nothing was recorded. {session.told()['ended']}")
        shown.last()
        status = "cancelled" if session.cancelled else "tripped" if run.trip else "completed"
        result = run.result(status, shown.elapsed)
        release()
        saved = save(order.recording, result)
    return Outcome(result.summary(), saved.sha256, saved.size)


class Shown(Viewers):
    """Shows a test with a client to its viewers, and stops it when it is cancelled."""

    open_ended = True

    def __init__(self, run: Any, order: RunOrder, line: Line):
        super().__init__(run, order.attempt, line)
        self.session: Any = None
        self._host = order.settings.rig_host
        self._client: dict[str, Any] = {}
        self._begun, self._told = time.perf_counter(), 0.0

    def waiting(self, address: str) -> None:
        """Tell viewers and the REST interface where the rig waits, and the line for the script of the client."""
        from rths_engine.client.words import lines, warning

        plan = self.run.plan
        transport = plan.client.transport
        port = int(address.rpartition(":")[2])
        words = {
            "address": address,
            "transport": transport,
            "lines": lines(plan, self._host, port),
            "note": warning(self._host),
        }
        self._client = {"state": "waiting", **words}
        self.tell(0.0, ended=False, client=self._client)
        self.line.progress(f"{WAITING} at {address} by {transport.upper()}", 0.0)

    def connected(self, peer: str) -> None:
        """Tell viewers that a client has connected, and start the clock."""
        self._begun, self._told = time.perf_counter(), 0.0
        self._client |= {"state": "connected", "peer": peer}
        self.tell(0.0, ended=False, client=self._client)

    def shown(self) -> bool:
        """Send frames, and from time to time the progress; returns whether the test was cancelled."""
        now = time.perf_counter()
        if self._client.get("state") == "connected":
            if now - self._told < PROGRESS_S:
                self.frame(ended=False)
            else:
                self._told = now
                self._tell(now, ended=False)
        return self.line.cancelled()

    def last(self) -> None:
        """Send what is left at the end."""
        self._tell(time.perf_counter(), ended=True)

    def _tell(self, now: float, ended: bool) -> None:
        told = self.session.told(RECENT) if self.session else {}
        few = {name: told[name] for name in ("steps", "step_ms", "iterations", "warnings") if name in told}
        self.tell(now - self._begun, ended, client=self._client | few)
