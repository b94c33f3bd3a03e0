"""The draw of the cases: kinds, levels, effects and strengths from a seed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from tests.proof.generator import outside
from tests.proof.generator import rig_effects as of_rig
from tests.proof.generator import structure_effects as of_structure
from tests.proof.generator.case import Case
from tests.proof.generator.draw_hybrid import hybrid_case
from tests.proof.generator.draw_rig import actuator_case, chain_case
from tests.proof.generator.draw_specimen import specimen_case
from tests.proof.generator.draw_structure import structure_case
from tests.proof.generator.rig_bench import OWN as OWN_OF_RIG
from tests.proof.generator.specimen_effects import COMMANDED, FACTORS, IDS, OWN, PAIRED, PLACED

CLEAN = 0.3  # of the cases
STRENGTHS = (3.0, 3000.0)  # lambda, drawn evenly over its logarithm
TOLD = 25.0  # least lambda of two effects and of physics outside the library: a smaller lambda is too weak to score
SENSORS = ("sensor_offset", "sensor_drift", "sensor_time_skew", "sensor_clipping", "sensor_dropout")
GROUND = tuple(f"input_{name}" for name in of_structure.INPUT)
SINGLE_PISTON = {"force_compliance", "backlash", "stick_friction"}  # the rig's piston has one of them


@dataclass(frozen=True)
class Kind:
    """A kind of test: its share of the cases, its levels with their shares, its effects, and the function that makes a case."""

    share: float
    levels: dict[str, float]
    single: tuple[str, ...]
    pairs: tuple[tuple[str, str], ...]
    strange: tuple[str, ...]
    made: Callable[..., Case]
    choice: Callable[[np.random.Generator, tuple[str, ...]], dict[str, Any]]  # what else a case is made of


@dataclass(frozen=True)
class Spec:
    """The description of a case; everything else follows from its seed."""

    name: str
    kind: str
    level: str
    seed: int
    made: dict[str, Any]

    def case(self) -> Case:
        return KINDS[self.kind].made(self.seed, self.level, **self.made)


def specs(count: int, seed: int, only: str | None = None) -> list[Spec]:
    """Draw the cases. `only` is KIND, LEVEL, KIND/LEVEL or KIND/EFFECT. Raises ValueError where no case matches it."""
    random = np.random.default_rng(seed)
    kinds, level, effect = _wanted(only)
    turns = {name: [_turns(random, some) for some in (one.single, one.pairs, one.strange)] for name, one in KINDS.items()}
    shares = np.array([KINDS[name].share for name in kinds])
    made = []
    for number in range(count):
        name = str(random.choice(kinds, p=shares / shares.sum()))
        kind = KINDS[name]
        chosen = level or ("clean" if random.random() < CLEAN else _drawn(random, kind.levels))
        low = TOLD if chosen in ("two", "outside") else STRENGTHS[0]
        wanted = float(np.exp(random.uniform(np.log(low), np.log(STRENGTHS[1]))))
        single, pairs, strange = turns[name]
        match chosen:
            case "clean":
                names: tuple[str, ...] = ()
            case "two":
                names = next(pairs)
            case "outside":
                names = (next(strange),)
            case _:
                names = (effect or next(single),)
        what = {"names": list(names), "wanted": wanted, **kind.choice(random, names)}
        made.append(Spec(f"{number:04d}-{name}-{chosen}", name, chosen, int(random.integers(2**31)), what))
    return made


def _law(random: np.random.Generator, names: tuple[str, ...]) -> dict[str, Any]:
    """A law of the specimen that does not contain the effects. A slider is solved first, so it takes no connection."""
    laws = [law for law in OWN if not OWN[law] & set(names) and not (law == "friction_slider" and PLACED & set(names))]
    return {"law": str(random.choice(laws))}


def _rig(random: np.random.Generator, names: tuple[str, ...]) -> dict[str, Any]:
    """A rig whose law does not contain the effects. The oil is compliant only with a damper that does not ring with it."""
    laws = ["mr_damper"] if "force_compliance" in names else [law for law, own in OWN_OF_RIG.items() if not own & set(names)]
    second = bool(
        random.random() < 0.4 and not set(names) & {"second_order_lag", "delay_error", "uneven_speed", "wandering_speed"}
    )
    return {"law": str(random.choice(laws)), "second": second}


def _release(random: np.random.Generator, names: tuple[str, ...]) -> dict[str, Any]:
    """Draw a free vibration, unless an error of the ground motion or of the mass is concealed."""
    return {"free": bool(random.random() < 0.15 and not {*GROUND, "mass_error"} & set(names))}


def _pairs() -> tuple[tuple[str, str], ...]:
    """Pairs of effects that act independently: beside a connection, only factors of the force."""
    return tuple(
        (one, other)
        for place, one in enumerate(PAIRED)
        for other in PAIRED[place + 1 :]
        if not ({one, other} & PLACED and not {one, other} & FACTORS)
        and {one, other} != {"coulomb_friction", "stribeck_friction"}
        and not COMMANDED & {one, other}
    )


KINDS = {
    "specimen": Kind(
        0.35,
        {"plain": 0.4, "noise": 0.15, "small": 0.1, "two": 0.17, "outside": 0.18},
        (*IDS, *SENSORS),
        _pairs(),
        outside.NAMES,
        specimen_case,
        _law,
    ),
    "actuator": Kind(
        0.2,
        {"plain": 0.45, "noise": 0.1, "small": 0.1, "missing": 0.1, "two": 0.1, "outside": 0.15},
        (*of_rig.ACTUATOR, "sensor_offset", "sensor_drift", "sensor_clipping", "sensor_dropout"),
        tuple(pair for pair in combinations(of_rig.PAIRED, 2) if not set(pair) <= SINGLE_PISTON),
        of_rig.OUTSIDE,
        actuator_case,
        _rig,
    ),
    "chain": Kind(0.05, {"missing": 1.0}, (*of_rig.SPECIMEN, *of_rig.ACTUATOR[:4]), (), (), chain_case, _rig),
    "hybrid": Kind(0.2, {"compensated": 0.8, "small": 0.2}, (*of_rig.SPECIMEN, *of_rig.ACTUATOR), (), (), hybrid_case, _rig),
    "structure": Kind(
        0.2,
        {"plain": 0.4, "noise": 0.12, "small": 0.08, "missing": 0.12, "two": 0.14, "outside": 0.14},
        (*of_structure.IDS, *GROUND),
        tuple(
            pair
            for pair in combinations(of_structure.PAIRED, 2)
            if "base_flexibility" not in pair and pair != ("cubic_stiffness", "gap_contact")
        ),
        of_structure.OUTSIDE,
        structure_case,
        _release,
    ),
}


def _wanted(only: str | None) -> tuple[list[str], str | None, str | None]:
    """The kinds to draw from, and the level and the effect of every case where they are given."""
    first, _, second = (only or "").partition("/")
    if first in KINDS and second in KINDS[first].single:
        return [first], "plain", second
    kind, level = (first, second) if first in KINDS else ("", second or first)
    kinds = [kind] if kind else [name for name, one in KINDS.items() if not level or level in (*one.levels, "clean")]
    known = not level or all(level in (*KINDS[name].levels, "clean") for name in kinds)
    if not kinds or not known or (second and not kind):
        levels = sorted({level for one in KINDS.values() for level in one.levels} | {"clean"})
        raise ValueError(f"kinds are {', '.join(KINDS)}; levels are {', '.join(levels)}; effects are in docs/physics.md")
    return kinds, level or None, None


def _drawn(random: np.random.Generator, shares: dict[str, float]) -> str:
    return str(random.choice(list(shares), p=np.array(list(shares.values())) / sum(shares.values())))


def _turns(random: np.random.Generator, values: tuple[Any, ...]) -> Iterator[Any]:
    while True:
        for place in random.permutation(len(values)):
            yield values[place]
