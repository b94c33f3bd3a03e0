"""Passes over whole signals against the steps of the loop, taken one after another in Python."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import actuators, physics, specimens
from rths_engine.parts.physics.effect import (
    COMMAND,
    F_SENSOR,
    FORCE,
    HEAT,
    INPUT,
    PART,
    PISTON,
    SERIES,
    X_SENSOR,
    Effect,
    amended,
)
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.running import passes, replay

DT, START, PRESSED = 1 / 512, 0.5, 10.0
RANDOM = np.random.default_rng(0)
X = np.cumsum(RANDOM.standard_normal(300)) * 1e-4
CURRENT = 1 + 0.1 * RANDOM.standard_normal(300)
LOAD = 1e4 * RANDOM.standard_normal(300)
WARMTH = 300.0 + 20.0 * RANDOM.standard_normal(300)
SEEN = Seen(float(np.abs(X).max()), 0.3, 1e5, 300 * DT, 1e4, DT)


def guesses(kinds: Sequence[type[Effect]]) -> list[Effect]:
    return [next(iter(physics.SEARCHES[kind].guesses(SEEN))) for kind in kinds]


OF_SPECIMEN = guesses([*physics.SPECIMEN, *(kind for kind in physics.SENSOR if issubclass(kind, OfForce))])
OF_ACTUATOR = guesses([*physics.ACTUATOR, *(kind for kind in physics.SENSOR if issubclass(kind, OfDisplacement))])


class Stepping:
    """The effects of a component at each hook, with their states."""

    def __init__(self, extended: Sequence[Effect]):
        self.built = [(effect, *effect.build(DT)) for effect in extended if effect.hook != PART]

    def at(self, hook: int, y: float, x: float, v: float, w: float, t: float) -> float:
        for effect, parameters, state in self.built:
            if effect.hook == hook:
                y = type(effect).step(parameters, state, y, x, v, w, t, DT)
        return y


def forces(part: Part, extended: Sequence[Effect]) -> Iterator[float]:
    """The loop's order of steps: displacement, force beside the specimen, reading. No effect acts in series."""
    parameters, state = (part := amended(part, extended)).build(DT)
    effects, force, last, last_u = Stepping(extended), PRESSED, X[0], None
    for q, x in enumerate(X):
        t, v = START + q * DT, (x - last) / DT
        u = effects.at(INPUT, x, x, v, force, t)
        last, last_u = x, u if last_u is None else last_u
        if isinstance(part, Commanded):
            part.energise(parameters, state, CURRENT[q], DT)
        force = part.step(parameters, state, u, DT)  # type: ignore[attr-defined]
        force = effects.at(FORCE, force, u, (u - last_u) / DT, CURRENT[q], t)
        force = effects.at(HEAT, force, u, (u - last_u) / DT, WARMTH[q], t)
        last_u = u
        yield effects.at(F_SENSOR, force, x, v, force, t)


def readings(part: Part, extended: Sequence[Effect]) -> Iterator[float]:
    parameters, state = (part := amended(part, extended)).build(DT)
    effects, x, v, last, force = Stepping(extended), 0.0, 0.0, 0.0, 0.0
    for q, command in enumerate(X):
        t = START + q * DT
        sent = effects.at(COMMAND, command, x, v, force, t)
        moved = part.step(parameters, state, sent, force)  # type: ignore[attr-defined]
        moved = effects.at(PISTON, moved, sent, (sent - last) / DT, force, t)
        x, v, last, force = moved, (moved - x) / DT, sent, LOAD[q]
        yield effects.at(X_SENSOR, x, x, v, x, t)


def close(ours: Array, steps: Iterator[float]) -> None:
    """Within the rounding of functions such as exp, which compiled code and Python may round differently."""
    expected = np.array(list(steps))
    assert ours == pytest.approx(expected, rel=1e-9, abs=1e-9 * max(1e-300, float(np.max(np.abs(expected)))))


@pytest.mark.parametrize("kind", specimens.KINDS, ids=lambda kind: kind.__name__)
def test_a_specimen_and_every_effect_give_the_forces_of_the_loops_steps(kind: type[Part]) -> None:
    pairs = [(first, Backlash(gap=1e-4)) for first in OF_SPECIMEN if first.hook in (FORCE, HEAT, F_SENSOR)]
    for extended in [(), *((effect,) for effect in OF_SPECIMEN), *pairs]:
        if all(effect.hook != SERIES for effect in extended):
            ours = replay.specimen(kind(), extended, X, CURRENT, DT, START, PRESSED, temperature=WARMTH)
            close(ours, forces(kind(), extended))


@pytest.mark.parametrize("kind", actuators.KINDS, ids=lambda kind: kind.__name__)
def test_an_actuator_and_every_effect_give_the_readings_of_the_loops_steps(kind: type[Part]) -> None:
    for extended in [(), *((effect,) for effect in OF_ACTUATOR)]:
        close(replay.actuator(kind(), extended, X, LOAD, DT, START), readings(kind(), extended))


def test_read_only_signals_are_not_compiled_for_anew() -> None:
    still = X.copy()
    still.flags.writeable = False
    replay.actuator(actuators.KINDS[0](), (), still, still, DT)
    replay.specimen(specimens.KINDS[0](), (), still[::2], CURRENT[::2], DT)
    assert len(passes._act_all.signatures) == len(passes._resist_all.signatures) == 1


def test_kept_forces_change_nothing() -> None:
    kept, part = replay.KeptForces(), specimens.KINDS[1]()
    for extended in [(), *((effect,) for effect in OF_SPECIMEN)] * 2:
        plain = replay.specimen(part, extended, X, CURRENT, DT, START, PRESSED)
        assert np.array_equal(replay.specimen(part, extended, X, CURRENT, DT, START, PRESSED, kept), plain)


def test_the_oldest_kept_forces_are_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(replay, "KEPT", 3)
    kept, asked = replay.KeptForces(), []
    resist = passes.resist

    def counted(part: Part, x: Array, current: Array, dt: float) -> Array:
        asked.append(part)
        return resist(part, x, current, dt)

    monkeypatch.setattr(passes, "resist", counted)
    parts = [specimens.KINDS[0](damping=float(size)) for size in range(4)]
    for part in (*parts, parts[3], parts[0]):
        kept.of(part, X, CURRENT, DT)
    assert asked == [*parts, parts[0]]
