"""A specimen with a command of its own, such as a current."""

from __future__ import annotations

from rths_engine.foundation.part import Part


class Commanded(Part):
    """A specimen with a command of its own, such as a current.

    `energise(p, s, w, dt)` updates the state s to the command w (A) of the substep, once before `step`. `at(w)` is the specimen
    under a constant command, without a command of its own.
    """

    @staticmethod
    def energise(p, s, w, dt):
        raise NotImplementedError

    def at(self, command: float) -> Part:
        raise NotImplementedError
