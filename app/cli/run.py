"""`rths run`: run a plan without a server."""

from __future__ import annotations

import json
import signal
import sys
import time
from argparse import Namespace
from collections.abc import Iterable
from types import FrameType
from typing import Any

from tqdm import tqdm

from app.cli.main import DONE, FAILED, INTERRUPTED, UNUSABLE
from app.cli.result import text
from app.cli.run_input import check_folder, read_model
from app.cli.settings import settings
from app.store.motions import motions_of
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.planning.plan import RealTime
from rths_engine.recordings.run_file import save
from rths_engine.running.opening import opened
from rths_engine.running.paced import PacedRun
from rths_engine.running.run import Run
from rths_engine.running.warm import warm

CHUNK_STEPS = 64  # of a test as fast as possible
NAP_S = 0.1


def run(given: Namespace) -> int:
    """`rths run`: run a plan. Exit code: 0 completed or tripped, 1 not stored, 2 invalid input, 130 interrupted."""
    try:
        if given.out:
            check_folder(given.out)
        model = read_model(given)
        warm()  # before a rig is connected, which must not wait
        with opened(model, motions_of(settings(given))) as test, Interrupt() as interrupt:
            elapsed_s = advance(test, interrupt)
    except RthsError as error:
        return _failed(error.issues, given.json, UNUSABLE)
    status = "tripped" if test.trip else "completed" if test.finished else "cancelled"
    result = test.result(status, elapsed_s)
    try:
        if given.out:
            save(given.out, result)
    except OSError as error:
        return _failed([Issue("--out", f"the recording was not stored: {error}", str(given.out))], given.json, FAILED)
    summary = result.summary()
    print(json.dumps(summary) if given.json else text(test.plan, summary, given.out))
    return INTERRUPTED if status == "cancelled" else DONE


class Interrupt:
    """Notes whether Ctrl-C was pressed. A second Ctrl-C ends the program at once."""

    def __enter__(self) -> Interrupt:
        self.asked = False
        self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)

    def _note(self, _: int, frame: FrameType | None) -> None:
        self.asked = True
        signal.signal(signal.SIGINT, signal.default_int_handler)


def advance(test: Run, interrupt: Interrupt) -> float:
    """Run a test at the pace of its plan, to its end or until interrupted. Returns the wall time (s)."""
    start = time.perf_counter()
    layout = "{l_bar}{bar}| {n:.1f} of {total:.1f} s simulated in {elapsed}, {remaining} left"
    with tqdm(total=test.total * test.dt, bar_format=layout, leave=False, disable=None) as bar:
        if isinstance(test.plan.pace, RealTime):
            _follow(PacedRun(test, test.plan.pace), interrupt, bar)
        while not test.finished and not interrupt.asked:
            new = test.advance(CHUNK_STEPS)
            bar.update((new.stop - new.start) * test.dt)
    return time.perf_counter() - start


def _follow(paced: PacedRun, interrupt: Interrupt, bar: tqdm[Any]) -> None:
    """Run a test in real time and show its progress, to its end or until interrupted."""
    paced.start()
    while not paced.take(NAP_S):
        bar.update(paced.run.done * paced.run.dt - bar.n)
        if interrupt.asked:
            paced.stop()


def _failed(issues: Iterable[Issue], as_json: bool, code: int) -> int:
    found = list(issues)
    for issue in found:
        print(f"rths run: {issue}", file=sys.stderr)
    if as_json:
        answer: dict[str, Any] = {"status": "failed", "errors": [issue.as_dict() for issue in found]}
        print(json.dumps(answer))
    return code
