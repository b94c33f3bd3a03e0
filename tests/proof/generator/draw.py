"""Which cases there are: kinds, levels, effects and strengths by a seed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.proof.generator import outside
from tests.proof.generator.case import Case
from tests.proof.generator.draw_specimen import FACTORS, IDS, OWN, PLACED, specimen_case

CLEAN = 0.3  # of the cases
STRENGTHS = (3.0, 3000.0)  # lambda, drawn evenly over its logarithm
SPECIMEN_LEVELS = {"plain": 0.4, "noise": 0.15, "small": 0.1, "two": 0.17, "outside": 0.18}
SENSORS = ("sensor_offset", "sensor_drift", "sensor_time_skew", "sensor_clipping", "sensor_dropout")


@dataclass(frozen=True)
class Spec:
    """A case to make: everything else follows from its seed."""

    name: str
    kind: str
    level: str
    seed: int
    made: dict[str, Any]

    def case(self) -> Case:
        return specimen_case(self.seed, self.level, **self.made)


def specs(count: int, seed: int, only: str | None = None) -> list[Spec]:
    """`only` is KIND, LEVEL or KIND/LEVEL."""
    random = np.random.default_rng(seed)
    kind, level = _wanted(only)
    single, pairs, strange = _turns(random, [*IDS, *SENSORS]), _turns(random, _pairs()), _turns(random, [*outside.NAMES])
    made = []
    for number in range(count):
        chosen = level or ("clean" if random.random() < CLEAN else _level(random))
        low, high = STRENGTHS
        wanted = float(np.exp(random.uniform(np.log(25.0 if chosen in ("two", "outside") else low), np.log(high))))
        match chosen:
            case "clean":
                names: tuple[str, ...] = ()
            case "two":
                names = next(pairs)
            case "outside":
                names = (next(strange),)
            case _:
                names = (next(single),)
        laws = [law for law in OWN if not OWN[law] & set(names) and not (law == "friction_slider" and PLACED & set(names))]
        law = str(random.choice(laws))
        what = {"law": law, "names": list(names), "wanted": wanted}
        name = f"{number:04d}-{kind or 'specimen'}-{chosen}"
        made.append(Spec(name, kind or "specimen", chosen, int(random.integers(2**31)), what))
    return made


def _wanted(only: str | None) -> tuple[str | None, str | None]:
    if only is None:
        return None, None
    first, _, second = only.partition("/")
    return (first, second or None) if first == "specimen" else (None, first)


def _level(random: np.random.Generator) -> str:
    return str(random.choice(list(SPECIMEN_LEVELS), p=list(SPECIMEN_LEVELS.values())))


def _pairs() -> list[tuple[str, str]]:
    """Two effects that act independently: a connection takes only factors of the force beside it."""
    return [
        (one, other)
        for place, one in enumerate(IDS)
        for other in IDS[place + 1 :]
        if not ({one, other} & PLACED and not {one, other} & FACTORS)
        and {one, other} != {"coulomb_friction", "stribeck_friction"}
        and "current_lag" not in (one, other)
    ]


def _turns(random: np.random.Generator, values: list[Any]) -> Iterator[Any]:
    while True:
        for place in random.permutation(len(values)):
            yield values[place]
