"""Try many examples of a strategy within bounds of time and memory, and collect what is wrong, each kind of fault once."""

from __future__ import annotations

import resource
import signal
import threading
import traceback
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import hypothesis
from hypothesis import HealthCheck, Phase
from hypothesis.strategies import SearchStrategy

# chosen: an ordinary example takes some milliseconds and MB
MOST_SECONDS = 10.0  # processor time of one example
MOST_BYTES = 600_000_000  # growth of the process by one example

Example = TypeVar("Example")


class TooLong(BaseException):
    """An example took more processor time than allowed. No reader may take it for an error of the file."""


@contextmanager
def bounded(seconds: float = MOST_SECONDS) -> Iterator[None]:
    """Raises TooLong after `seconds` of processor time, which a loaded machine does not change; main thread only."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def late(*_: Any) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def faults(
    strategy: SearchStrategy[Example], wrong: Callable[[Example], str | None], examples: int, seed: int
) -> Iterator[str]:
    """What `wrong` says of the examples; also every error that it raises, and each example beyond the bounds."""

    def all_wrong(example: Example) -> Iterator[str]:
        fault = _fault(example, wrong)
        if fault is not None:
            yield fault

    yield from each_once(strategy, all_wrong, examples, seed)


def each_once(
    strategy: SearchStrategy[Example],
    wrong: Callable[[Example], Iterable[str]],
    examples: int,
    seed: int,
    patient: bool = True,
) -> Iterator[str]:
    """What `wrong` says of the examples, each kind of fault (the words before its first colon) once.

    Without patience a strategy that gives no example in 50 draws raises FailedHealthCheck; with it, in thousands.
    """
    found: dict[str, str] = {}

    @hypothesis.seed(seed)
    @hypothesis.settings(
        max_examples=examples,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=[one for one in HealthCheck if patient or one is not HealthCheck.filter_too_much],
    )
    @hypothesis.given(example=strategy)
    def tried(example: Example) -> None:
        for fault in wrong(example):
            found.setdefault(fault.partition(":")[0], fault)

    tried()
    yield from found.values()


def _fault(example: Any, wrong: Callable[[Any], str | None]) -> str | None:
    size = _largest()
    try:
        with bounded(), warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of numpy, about numbers that are out of range
            fault = wrong(example)
    except TooLong:
        fault = f"takes more than {MOST_SECONDS:g} s: {_shown(example)}"
    except Exception as error:
        at = traceback.extract_tb(error.__traceback__)[-1]
        fault = f"{type(error).__name__} in {at.filename.rpartition('/')[2]} line {at.lineno}: {error!s:.300} {_shown(example)}"
    if fault is None and _largest() - size > MOST_BYTES:
        fault = f"takes more than {MOST_BYTES / 1e6:g} MB: {_shown(example)}"
    return fault


def _largest() -> int:
    """The largest size (bytes) that this process had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def _shown(example: Any) -> str:
    text = repr(example)
    return text if len(text) < 2000 else text[:2000] + "…"
