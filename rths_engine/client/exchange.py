"""The exchange with a client: which messages move the rig, and how each is answered.

A step of the client begins with the first trial displacement at a new time. The rig moves on the first new displacement of a
step only, from the last one to the new one within the controller steps between the two times: a rig cannot move back and try
again. It measures at the end of the ramp. A step without a new displacement holds the rig until its commit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from rths_engine.client.ended import Ended
from rths_engine.client.layout import SHUTDOWN, Layout
from rths_engine.client.rig import Rig
from rths_engine.foundation.arrays import Array
from rths_engine.wire.generic import Action

# chosen; see docs/decisions/0023
SAME = 1e-9  # relative change of a displacement that is rounding of the client
OFF_GRID = 1e-3  # controller steps between a time of the client and the nearest controller step
IGNORED = (Action.OPEN, Action.SETUP, Action.EXECUTE)
ORDER = (Action.DISPLACEMENT, Action.VELOCITY, Action.ACCELERATION, Action.FORCE, Action.TIME)  # in an answer to Action.DATA
ITERATES = (
    "The integrator of the client iterates: at {time:.6g} s it sent a second displacement within a step. The rig stayed at the "
    "first, because a rig cannot move back. Use an integrator with one displacement a step: algorithm Linear with an explicit "
    "scheme (NewmarkExplicit, KRAlphaExplicit_TP) or an operator-splitting scheme (AlphaOS, AlphaOSGeneralized_TP)."
)
OFF_STEP = (
    "The steps of the client are no multiple of the controller step of {step:.6g} s: a step of {given:.6g} s is {count:.4g} of "
    "them. Ramps end at the nearest controller step. Choose a step of {fit:.9g} s, or another controller rate."
)
AHEAD = (
    "The client sends each displacement with the time before its step, as OpenSees' CentralDifference does. The rig reaches it "
    "a step of {step:.6g} s, that of the plan, after this time."
)
RESTARTED = "The client set its time back at {time:.6g} s. The rig goes on from there."


class Exchange:
    """Takes the messages of one client in order. `warnings` holds a sentence of each kind.

    `iterations` counts trial displacements that the rig did not follow, and `unfollowed` (m) is the largest difference between
    a committed displacement and the rig's command.
    """

    def __init__(self, layout: Layout, rig: Rig):
        self.layout, self.rig, self.plan = layout, rig, rig.run.plan
        self.warnings: dict[str, str] = {}
        self._counted = [0] * (Action.END + 1)
        self.steps = self.iterations = 0
        self.unfollowed = 0.0
        count = layout.count
        self._time_at, self._step = layout.time, self.plan.client.step
        self._command = self._seen = self._committed = (0.0,) * count  # of the rig; last sent; last of the step before
        self._time: float | None = None  # of the step
        self._longest = self._step or 0.0  # step so far, s
        self._origin, self._first = 0.0, 0  # a time of the client, and its controller step
        self._ahead = 0  # controller steps from a time of the client to the displacement sent with it
        self._moved = self._open = False
        self._answers = _answers(layout, rig, lambda: self._time or 0.0)
        self._own: dict[float, Callable[[tuple[float, ...]], None]] = {
            Action.SET_TRIAL: self._trial,
            Action.COMMIT: self._commit,
            Action.END: self._die,
            SHUTDOWN: self._die,
        }

    @property
    def counts(self) -> dict[int, int]:
        """Number of messages by action code."""
        return {code: count for code, count in enumerate(self._counted) if count}

    @property
    def _reads_all(self) -> bool:
        """Whether the client reads all quantities at once, as OpenFresco does, which sends no commit."""
        return self._counted[Action.DATA] > 0

    def take(self, numbers: tuple[float, ...]) -> memoryview | None:
        """The answer to a message, or None for a message without answer. Raises Ended."""
        code = numbers[0]
        answer = self._answers.get(code)
        if answer is not None:
            self._counted[int(code)] += 1
            return answer()
        act = self._own.get(code)
        if act is None and code not in IGNORED:
            raise Ended(
                f"The client sent the action code {code:g}, which this protocol does not have. Its data size or byte order may "
                "differ from those it announced; OpenFresco's -initFile is not supported."
            )
        self._counted[int(code)] += 1
        if act is not None:
            act(numbers)
        return None

    def _trial(self, numbers: tuple[float, ...]) -> None:
        target = numbers[1 : 1 + self.layout.count]
        time = self._when(numbers, target)
        if not (all(map(math.isfinite, target)) and math.isfinite(time)):
            raise Ended(f"The client sent a displacement or a time that is not a number after {self._time or 0.0:.6g} s.")
        if time != self._time:
            self._begin(time)
        if target == self._committed and not self._moved:
            return
        self._seen = target
        if not self._moved:
            self._move(target, time)
        elif _apart(target, self._command) > SAME * max(map(abs, target)):
            self.iterations += 1
            self.warnings.setdefault("iterates", ITERATES.format(time=time))

    def _when(self, numbers: tuple[float, ...], target: tuple[float, ...]) -> float:
        """The time of a trial displacement; without one of the client, each new displacement is a step of the plan's length."""
        if self._time_at is not None:
            return numbers[self._time_at]
        if self._step is None:
            raise Ended("The client sends no time. Give the plan the step of the client, or let the client send its time.")
        if self._time is None:
            return 0.0
        return self._time if target == self._seen else self._time + self._step

    def _begin(self, time: float) -> None:
        """Begin the step that ends at `time`."""
        if self._time is None:
            if time + OFF_GRID * self.rig.run.dt == time:
                raise Ended(
                    f"The time of the client begins at {time:.6g} s. Times as large are rounded to more than a thousandth of a "
                    f"controller step of {self.rig.run.dt:.6g} s. Begin near zero."
                )
            self._origin = time
            self._longest = max(self._longest, time)
        elif self._open and not self._reads_all and self._time_at is not None:
            raise Ended(
                f"The client began a step to {time:.6g} s before it committed that to {self._time:.6g} s: its step failed, or "
                "its commit is missing. The rig cannot repeat a step."
            )
        elif time < self._time:
            if not 0 < time <= self._longest * (1 + SAME):
                raise Ended(f"The client set its time back from {self._time:.6g} s to {time:.6g} s.")
            self.warnings.setdefault("restarted", RESTARTED.format(time=self._time))
            self._hold()
            self._origin, self._first = 0.0, self.rig.run.done
        elif self._open:
            self._hold()
            self.steps += 1
        if self._time is not None:
            self._longest = max(self._longest, time - self._time)
        self._open = self._time is not None
        self._time, self._moved, self._committed = time, False, self._seen

    def _move(self, target: tuple[float, ...], time: float) -> None:
        steps = self._until(time)
        if steps < 1 and self._step and not self._ahead:
            self._ahead = round(self._step * self.plan.controller_rate)
            self._first += self._ahead
            steps += self._ahead
            self.warnings.setdefault("ahead", AHEAD.format(step=self._step))
        if steps < 1:
            raise Ended(
                f"The client moved the rig at {time:.6g} s without a step in time: a step is at least one controller step of "
                f"{self.rig.run.dt:.6g} s. A test starts at zero displacement. A client that sends each displacement with the "
                "time before its step, such as OpenSees' CentralDifference, needs its step in the plan (client.step)."
            )
        self._command, self._moved = target, True
        self.rig.move(target, steps)

    def _until(self, time: float) -> int:
        """Controller steps from the present one to the one nearest to a time of the client."""
        run = self.rig.run
        exact = (time - self._origin) * self.plan.controller_rate
        if exact > run.total + 1:
            exact = run.total + 1.0  # the rig refuses it
        nearest = round(exact)
        steps = self._first + nearest - run.done
        if abs(exact - nearest) > OFF_GRID and "grid" not in self.warnings:
            given = exact + self._first - run.done
            fit = max(1, round(given)) * run.dt
            self.warnings["grid"] = OFF_STEP.format(step=run.dt, given=given * run.dt, count=given, fit=fit)
        return steps

    def _commit(self, numbers: tuple[float, ...]) -> None:
        self._hold()
        if self._open:
            self.steps += 1
        if self._moved:
            self.unfollowed = max(self.unfollowed, _apart(self._seen, self._command))
        self._open, self._committed = False, self._seen

    def _hold(self) -> None:
        """Hold the rig until the end of a step that did not move it."""
        steps = 0 if self._moved or self._time is None else self._until(self._time)
        if steps > 0:
            self.rig.move(self._command, steps)

    def _die(self, numbers: tuple[float, ...]) -> None:
        self.steps += self._open
        raise Ended("The client ended the test.", orderly=True)


def _apart(first: tuple[float, ...], second: tuple[float, ...]) -> float:
    return max(abs(a - b) for a, b in zip(first, second, strict=True))


def _answers(layout: Layout, rig: Rig, time: Callable[[], float]) -> dict[float, Callable[[], memoryview]]:
    """How each code is answered. Every answer has a message of its own, made once.

    Damping and mass are zero: the measured force contains the specimen's, and OpenSees adds the products of these answers with
    velocity and acceleration to it.
    """
    run, count = rig.run, layout.count
    stiffness = np.diag([station.equivalent_stiffness for station in run.plan.stations])
    constant = {Action.INITIAL_STIFFNESS: stiffness, Action.TANGENT_STIFFNESS: stiffness}
    constant |= {Action.DAMPING: np.zeros((count, count)), Action.MASS: np.zeros((count, count))}
    live: dict[Action, Callable[[], Any]] = {
        Action.DISPLACEMENT: lambda: run.x_meas,
        Action.VELOCITY: lambda: rig.rate(1),
        Action.ACCELERATION: lambda: rig.rate(2),
        Action.FORCE: lambda: run.f_meas,
        Action.TIME: time,
    }
    answers: dict[float, Callable[[], memoryview]] = {}
    for code, matrix in constant.items():
        message, numbers = _message(layout)
        numbers[: matrix.size] = matrix.ravel()
        answers[code] = lambda message=message: message  # type: ignore[misc]
    for code, value in live.items():
        answers[code] = _filled(*_message(layout), [(slice(0, 1 if code == Action.TIME else count), value)])
    places, first = [], 0
    for number, kind in zip(layout.read, ORDER, strict=True):
        if number:
            places.append((slice(first, first + number), live[kind]))
        first += number
    answers[Action.DATA] = _filled(*_message(layout), places)
    return answers


def _message(layout: Layout) -> tuple[memoryview, Array]:
    """An empty message, and its numbers."""
    buffer = bytearray(layout.bytes)
    return memoryview(buffer), np.frombuffer(buffer, "<f8")


def _filled(message: memoryview, numbers: Array, places: list[tuple[slice, Callable[[], Any]]]) -> Callable[[], memoryview]:
    def answer() -> memoryview:
        for place, value in places:
            numbers[place] = value()
        return message

    return answer
