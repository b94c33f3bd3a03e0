"""The electro-mechanical positioning system: a carriage on a ball screw under position control.

Source: Janot, Gautier and Brunot, Data Set and Reference Models of EMPS, Workshop on Nonlinear System Identification
Benchmarks, Eindhoven 2019.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.diagnosis.components import SpecimenData
from rths_engine.foundation.arrays import Array
from rths_engine.parts.physics.sensor.offset import ForceOffset
from rths_engine.parts.physics.specimen.added_inertia import AddedInertia
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.scores.files import matlab
from rths_engine.scores.score import Entry, Score
from rths_engine.scores.specimens import Law, errors

# published figures and split: docs/scores.md
SCORE = Score(
    "emps",
    "Positioning system (EMPS)",
    "relative error of the motor force, √(Σe² / Σf²)",
    "",
    "fitted to DATA_EMPS.mat, tested on DATA_EMPS_PULSES.mat",
    "nonlinearbenchmark.org, Electro-Mechanical Positioning System (Janot, Gautier and Brunot 2019)",
    (
        Entry("friction models of the publication, smallest error", 0.039),
        Entry("friction models of the publication, largest error", 0.046),
    ),
)
# chosen; see docs/decisions/0023
CHANNELS = {"qm", "qg", "vir", "gtau", "t"}
MASS, FRICTION, PRESLIDING, OFFSET = 50.0, 10.0, 1e-5, 1.0  # kg, N, m, N: starting sizes
TRAINED = 0.7  # share of the one record that is fitted where the other is lacking

LAWS = (
    Law("mass and viscous friction", False, (AddedInertia(mass=MASS),)),
    Law(
        "mass, viscous and Coulomb friction, offset",
        False,
        (AddedInertia(mass=MASS), CoulombFriction(friction=FRICTION, presliding=PRESLIDING), ForceOffset(error=OFFSET)),
    ),
)


def score(folder: Path) -> Score:
    """The score on the records of EMPS in the folder, which are recognised by their variables.

    The name tells the record with pulses from the other, because both have the same variables.
    """
    found = {"PULSES" in path.stem.upper(): values for path, values in matlab(folder, CHANNELS)}
    lacks = [name for name, there in (("DATA_EMPS.mat", False), ("DATA_EMPS_PULSES.mat", True)) if there not in found]
    if False not in found:
        return SCORE.scored((), "", lacks)
    plain = found[False]
    if not lacks:
        return SCORE.scored(errors(LAWS, [data(plain)], [data(found[True])]), SCORE.split)
    count = round(TRAINED * len(plain["t"]))
    first, last = (data(plain, part) for part in (slice(count), slice(count, None)))
    used = f"fitted to the first {100 * TRAINED:.0f} % of DATA_EMPS.mat, tested on the rest"
    return SCORE.scored(errors(LAWS, [first], [last]), used, lacks)


def data(values: dict[str, Array], part: slice = slice(None)) -> SpecimenData:
    """A record as the data of a specimen: position of the carriage (m) and motor force (N) = gain (N/V) times voltage (V)."""
    time, x = values["t"][part], values["qm"][part]
    force: Any = values["gtau"][0] * values["vir"][part]
    return SpecimenData(float(np.mean(np.diff(time))), 0.0, False, x, force, np.ones(len(x)))
