"""The Silverbox: an electronic oscillator with a hardening spring, driven by a voltage.

Source: Wigren and Schoukens, Three free data sets for development and benchmarking in nonlinear system identification,
European Control Conference 2013, 2933-2938. The samples of the split are those of nonlinearbenchmark.org.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import least_squares

from rths_engine.diagnosis.components import Structure, StructureData, based
from rths_engine.diagnosis.components.structure import Release
from rths_engine.diagnosis.fitting import Recordings, fit
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.noise_of import first_noise
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.physics.structure.cubic_stiffness import CubicStiffness
from rths_engine.planning.reading import read_plan
from rths_engine.scores.files import matlab
from rths_engine.scores.score import Entry, Score, rms_error

# published figures and split: docs/scores.md
SCORE = Score(
    "silverbox",
    "Hardening oscillator (Silverbox)",
    "RMS error of the free run on the arrow",
    "mV",
    "fitted to samples 40650 to 105712 (multisine), tested on samples 100 to 40575 (arrow), start from its first 50 samples",
    "nonlinearbenchmark.org, Silverbox: SNLS80mV.mat (Wigren and Schoukens 2013)",
    (Entry("linear model", 14.0), Entry("linear model with a cubic spring", 1.66), Entry("black box", 4.15)),
)
# of the published file: docs/scores.md
RATE = 610.35  # Hz
SAMPLES = 131072

# chosen; see docs/decisions/0023
SLOWER = 10.0  # times: the oscillation of 68 Hz becomes one of 7 Hz, which is in the band of a diagnosis
NEWTON = 1e6  # N for a volt of the input; the output in V counts as m


class Split(NamedTuple):
    """The samples to fit and to test; the first `begun` samples of the test give its start and are not scored."""

    fitted: slice
    tested: slice
    begun: int


# docs/scores.md
PUBLISHED = Split(slice(40650, 105712), slice(100, 40575), 50)


def score(folder: Path) -> Score:
    """The score on the Silverbox record in the folder, which is recognised by its variables V1 and V2."""
    for path, values in matlab(folder, {"V1", "V2"}):
        if len(values["V1"]) == len(values["V2"]) == SAMPLES:
            return SCORE.scored(errors(values["V1"], values["V2"], PUBLISHED), SCORE.split)
        found = f"SNLS80mV.mat with {SAMPLES} samples ({path.name} has {len(values['V1'])})"
        return SCORE.scored((), "", [found])
    return SCORE.scored((), "", ["SNLS80mV.mat"])


def errors(u: Array, y: Array, split: Split) -> list[Entry]:
    """RMS errors (mV) of the free run of the linear oscillator and of the oscillator with a cubic spring. u and y are in V."""
    trained, tested = data(u[split.fitted], y[split.fitted]), data(u[split.tested], y[split.tested])
    component = planned(trained)
    linear = fitted(component, trained, component.base)
    size = float(component.built.stiffness[0, 0]) / float(np.max(np.abs(trained.floors[0][2]))) ** 2
    cubic = fitted(component, trained, [*linear, CubicStiffness(storey=1, stiffness=0.1 * size)])
    found = []
    for name, parts in (("linear oscillator", linear), ("oscillator with a cubic spring", cubic)):
        simulated = component.predicted(started(component, parts, tested, split.begun), tested)[0]
        after = slice(split.begun, None)
        found.append(Entry(name, 1e3 * rms_error(tested.floors[0][2][after], simulated[after])))
    return found


def data(u: Array, y: Array) -> StructureData:
    """A part of the record as the data of a structure, SLOWER times slower. Its start is the first sample at rest."""
    dt = SLOWER / RATE
    return StructureData(dt, 0.0, False, np.zeros(len(u)), {1: NEWTON * u}, (("x", 1, y),), ((float(y[0]),), (0.0,)), 1)


def planned(trained: StructureData) -> Structure:
    """The oscillator m a + c v + k x = f by linear regression on central differences, with masses and all known as a guess."""
    x, dt = trained.floors[0][2], trained.dt
    v, a = (x[2:] - x[:-2]) / (2 * dt), (x[2:] - 2 * x[1:-1] + x[:-2]) / dt**2
    terms = np.column_stack([a, v, x[1:-1]])
    m, c, k = np.linalg.lstsq(terms, trained.forces[1][1:-1], rcond=None)[0]
    ratio = max(1e-3, float(c) / (2 * float(np.sqrt(m * k))))
    plan = read_plan(
        {
            "test": "structure",
            "structure": {
                "kind": "shear_building",
                "storeys": [{"mass": float(m), "stiffness": float(k)}],
                "damping_ratio": ratio,
            },
            "integrator": {"kind": "cr", "dt": 1 / 64, "substeps": 1},
            "controller_rate": 64.0,
            "duration": 1.0,
            "known": {"structure.mass": "guess", "structure.stiffness": "guess", "structure.damping": "guess"},
        }
    )
    return Structure("structure", based(plan, True, [1]), plan)


def fitted(component: Structure, trained: StructureData, parts: Sequence[Part]) -> tuple[Part, ...]:
    """The parts after a least-squares fit to all samples."""
    ones: Array = np.ones(trained.measured.shape)
    plain = Recordings(component, (trained,), (np.ones(ones.shape[1]) > 0,), (Noise.white(1.0),), (ones,), (ones,))
    return fit(first_noise(plain), parts).parts


def started(component: Structure, parts: Sequence[Part], tested: StructureData, begun: int) -> list[Part]:
    """The parts with the start of the tested samples, fitted to the first `begun` of them alone."""
    x, force = tested.floors[0][2], tested.forces[1]
    first = replace(tested, ground=tested.ground[:begun], forces={1: force[:begun]}, floors=(("x", 1, x[:begun]),))

    def moved(z: Any) -> list[Part]:
        start = Release(floor=1, displacement=float(z[0]), velocity=float(z[1]))
        return [start if isinstance(part, Release) else part for part in parts]

    def off(z: Any) -> Array:
        found: Array = (component.predicted(moved(z), first) - first.measured)[0]
        return found

    scale = float(np.std(x))
    return moved(least_squares(off, np.zeros(2), x_scale=[scale, scale / tested.dt]).x)
