"""States of a job, and the table of allowed transitions."""

from __future__ import annotations

from enum import StrEnum

from app.problems import Conflict


class State(StrEnum):
    """State of a job. A job that is to be approved is not in the queue yet: nothing that starts queued jobs can start it."""

    TO_APPROVE = "to approve"
    QUEUED = "queued"
    RUNNING = "running"
    COMPLETED = "completed"
    TRIPPED = "tripped"
    CANCELLED = "cancelled"
    FAILED = "failed"

    @property
    def ended(self) -> bool:
        return self not in {State.TO_APPROVE, State.QUEUED, State.RUNNING}

    @staticmethod
    def values(kind: type[State]) -> list[str]:
        return [state.value for state in kind]


# running -> queued: the worker of the job has died
# cancelled -> queued, to approve: the cancel of a job that had not started was undone
# failed -> an end with a result: the store had not taken the result, which its worker kept and sent later
TRANSITIONS: dict[State, frozenset[State]] = {
    State.TO_APPROVE: frozenset({State.QUEUED, State.CANCELLED}),
    State.QUEUED: frozenset({State.RUNNING, State.CANCELLED, State.FAILED}),
    State.RUNNING: frozenset({State.QUEUED, State.COMPLETED, State.TRIPPED, State.CANCELLED, State.FAILED}),
    State.COMPLETED: frozenset(),
    State.TRIPPED: frozenset(),
    State.CANCELLED: frozenset({State.QUEUED, State.TO_APPROVE}),
    State.FAILED: frozenset({State.COMPLETED, State.TRIPPED, State.CANCELLED}),
}


class IllegalTransition(Conflict):
    """A change of state that is not in TRANSITIONS."""

    def __init__(self, noun: str, old: State, new: State):
        self.old, self.new = old, new
        ended = f"has already ended: it is {old}" if old.ended else f"is {old}"
        super().__init__(f"The {noun} {ended} and cannot become {new}.")


def check(old: State, new: State, noun: str = "job") -> None:
    """Raise IllegalTransition unless a job may go from state `old` to state `new`."""
    if new not in TRANSITIONS[old]:
        raise IllegalTransition(noun, old, new)
