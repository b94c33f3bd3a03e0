"""States of a run, and the one table of what may follow what."""

from __future__ import annotations

from enum import StrEnum


class State(StrEnum):
    QUEUED = "queued"
    RUNNING = "running"
    COMPLETED = "completed"
    TRIPPED = "tripped"
    CANCELLED = "cancelled"
    FAILED = "failed"

    @property
    def ended(self) -> bool:
        return not TRANSITIONS[self]

    @staticmethod
    def values(kind: type[State]) -> list[str]:
        return [state.value for state in kind]


# a running test goes back to the queue when its worker died
TRANSITIONS: dict[State, frozenset[State]] = {
    State.QUEUED: frozenset({State.RUNNING, State.CANCELLED, State.FAILED}),
    State.RUNNING: frozenset({State.QUEUED, State.COMPLETED, State.TRIPPED, State.CANCELLED, State.FAILED}),
    State.COMPLETED: frozenset(),
    State.TRIPPED: frozenset(),
    State.CANCELLED: frozenset(),
    State.FAILED: frozenset(),
}


class IllegalTransition(Exception):
    """A change of state that TRANSITIONS does not have."""

    def __init__(self, old: State, new: State):
        self.old, self.new = old, new
        super().__init__(f"the test is {old} and can't become {new}")


def check(old: State, new: State) -> None:
    """Raises IllegalTransition."""
    if new not in TRANSITIONS[old]:
        raise IllegalTransition(old, new)
