"""Orders: what a calculation executes, as bytes. Made and read in the thread that asks, never on the event loop.

A service of a request may be an argument. Its session of the database becomes a session of the process, which reads what was
committed and never commits (app/db.py); its durable queue is left out, and its own calculations are done in the same process.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

from app.calculations.bound import Bound

P = ParamSpec("P")
T = TypeVar("T")


class Here:
    """Calculations of a process that is itself a calculation: done at once, within its bounds."""

    def __call__(self, _: Bound, function: Callable[P, T], /, *arguments: P.args, **named: P.kwargs) -> T:
        return function(*arguments, **named)


def order(bound: Bound, function: Callable[..., Any], arguments: Sequence[Any], named: Mapping[str, Any]) -> bytes:
    """The order to call a function within a bound."""
    return pickle.dumps((function, tuple(arguments), dict(named), bound.seconds, bound.megabytes), pickle.HIGHEST_PROTOCOL)
