"""The banded rotary friction damper: a band brake with play, moved by an actuator.

Source: Coble, Cao, Downey and Ricles, Physics-informed machine learning for dry friction and backlash modeling in structural
control systems, Mechanical Systems and Signal Processing 2024; data sets of the ARTS Laboratory, CC BY-SA 4.0.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.diagnosis.components import SpecimenData
from rths_engine.foundation import units
from rths_engine.parts.physics.specimen.asymmetry import Asymmetry
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.scores.files import json_with
from rths_engine.scores.score import Entry, Score
from rths_engine.scores.specimens import Law, errors

# published figures and split: docs/scores.md
SCORE = Score(
    "brfd",
    "Friction damper (BRFD)",
    "pooled relative error of the force over all earthquakes, √(Σe² / Σf²)",
    "",
    "fitted to the characterisation tests with 36 lb of tension, tested on four earthquakes",
    "github.com/ARTS-Laboratory/Dataset-Friction-Damper-with-Backlash, data set 2 (Coble, Cao, Downey and Ricles)",
    (Entry("friction model of the publication", 0.588),),
)
KEYS = {"data", "dt", "displacement units", "friction force units"}
TENSION = "36lbtension"
EARTHQUAKES = ("ImperialValleyDBE", "ImperialValleyMCE", "KocaeliDBE", "KocaeliMCE")
# chosen; see docs/decisions/0023
FRICTION, PRESLIDING, GAP = 1e4, 2e-3, 4e-3  # N, m, m: starting sizes
FRICTIONAL = CoulombFriction(friction=FRICTION, presliding=PRESLIDING)

LAWS = (
    Law("spring and dashpot", True, ()),
    Law("friction with pre-sliding", True, (FRICTIONAL,)),
    Law("friction, play, asymmetry", True, (FRICTIONAL, Backlash(gap=GAP), Asymmetry())),
)


def score(folder: Path) -> Score:
    """The score on the data sets of the damper in the folder. Files state columns and units, their names the test."""
    found = {path.stem: held for path, held in json_with(folder, KEYS)}
    trained = [name for name in sorted(found) if TENSION in name]
    tested = [name for name in EARTHQUAKES if name in found]
    lacks = [f"{name}.json" for name in EARTHQUAKES if name not in found]
    if not trained:
        lacks = [f"characterisation tests (*{TENSION}*.json)", *lacks]
    if not trained or not tested:
        return SCORE.scored((), "", lacks)
    ours = errors(LAWS, [data(found[name]) for name in trained], [data(found[name]) for name in tested])
    used = f"fitted to {len(trained)} characterisation tests with 36 lb of tension, tested on {', '.join(tested)}"
    return SCORE.scored(ours, used, lacks)


def data(held: dict[str, Any]) -> SpecimenData:
    """A file as the data of a specimen: displacement (m) and friction force (N), with the units that the file states."""
    rows = np.asarray(held["data"], dtype=float)
    x = rows[:, 1] * units.factor(held["displacement units"])
    force = rows[:, 2] * units.factor(held["friction force units"])
    return SpecimenData(float(held["dt"]), 0.0, False, x, force, np.ones(len(x)))
