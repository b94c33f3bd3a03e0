"""The probability that a named effect is truly present: a logistic map of the facts of its proof.

`rths prove --calibrate` writes the weights to calibration.json.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, ClassVar

# chosen; see docs/decisions/0030
MOST_ALONE, MOST_SAME, MOST_PART = 0.95, 0.8, 0.45  # without a second recording; without another motion; for a part of it
CLIPPED = 6.0  # log odds


@dataclass(frozen=True)
class Facts:
    """What is known of a claim: the arguments of its probability.

    `mass` is the stacked weight of the models with the effect, `evidence` its probability by evidence, and `certainty` the gain
    in standard errors. `remaining` is the share of the held-out error beyond the noise that remains. `flexible` is the held-out
    advantage of the flexible law in units of the planned model's disadvantage. `unexplained` is the chi^2 that a general law
    explains for sure after the effects, over the chi^2 that the effects explain. `share` is the share of the
    held-out error beyond the noise that the effect explains. The gain of `doubted` effects is not
    clearly above zero, or they have a twin that the recording cannot tell from them.
    """

    mass: float
    evidence: float
    certainty: float
    remaining: float
    flexible: float
    unexplained: float
    share: float
    other_motion: bool
    replicated: bool
    part_of_it: bool
    doubted: bool

    NAMES: ClassVar = ("constant", "mass", "evidence", "certainty", "remaining", "flexible", "unexplained", "share")

    @property
    def row(self) -> tuple[float, ...]:
        """The numbers that the map weighs."""
        return (
            1.0,
            log_odds(self.mass),
            log_odds(self.evidence),
            math.log1p(min(max(self.certainty, 0.0), 50.0)),
            min(max(self.remaining, 0.0), 1.5),
            min(max(self.flexible, -1.0), 1.0),
            math.log10(min(max(self.unexplained, 1e-3), 10.0)),
            math.log10(min(max(self.share, 1e-3), 1.0)),
        )


TABLE: dict[str, Any] = json.loads((files(__package__) / "calibration.json").read_text(encoding="utf-8"))
WEIGHTS: tuple[float, ...] = tuple(TABLE["weights"].values())


def probability(facts: Facts, weights: Sequence[float] = WEIGHTS) -> float:
    """Probability that the effect is truly present, within what the held-out data can show."""
    raw = sum(weight * value for weight, value in zip(weights, facts.row, strict=True))
    found = 1 / (1 + math.exp(-min(max(raw, -30.0), 30.0)))
    if facts.part_of_it or facts.doubted:
        found = min(found, MOST_PART)
    if not facts.other_motion:
        found = min(found, MOST_SAME)
    return found if facts.replicated else min(found, MOST_ALONE)


def log_odds(share: float) -> float:
    """Log odds of a share, within CLIPPED of even odds."""
    share = min(max(share, 1e-12), 1 - 1e-12)
    return min(max(math.log(share / (1 - share)), -CLIPPED), CLIPPED)
