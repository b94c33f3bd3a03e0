"""Models of a specimen, fitted to some recordings and scored on others."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from rths_engine.diagnosis.components import ClockSkew, Specimen, SpecimenData, StepError
from rths_engine.diagnosis.fitting import Fitted, Recordings, fit
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.noise_of import first_noise
from rths_engine.foundation.arrays import Array
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.scores.score import Entry, pooled_error

# chosen; see docs/decisions/0023
ENDS = 0.3  # s at each end of a recording that are not scored: the filters blur the signals there
SMALL = 1e-3  # of the largest force: the force of the first spring and dashpot at the largest displacement and velocity


class Law(NamedTuple):
    """A model to score: its name, whether it has a spring, and the effects beside spring and dashpot, at starting sizes."""

    name: str
    spring: bool
    effects: tuple[Effect, ...]


def errors(laws: Sequence[Law], trained: Sequence[SpecimenData], tested: Sequence[SpecimenData]) -> list[Entry]:
    """The pooled relative error of each law on the tested recordings, after a fit to the trained recordings.

    A law begins where the law before it was fitted, so effects that both have are not searched again.
    """
    found, before = [], None
    for law in laws:
        component, fitted = fitted_law(law, trained, before)
        before = fitted
        component.settle(fitted.parts, tested)
        pairs = [_compared(component, fitted, one) for one in tested]
        found.append(Entry(law.name, pooled_error(pairs)))
    return found


def fitted_law(law: Law, trained: Sequence[SpecimenData], before: Fitted | None = None) -> tuple[Specimen, Fitted]:
    """A law fitted to recordings by least squares, with spring, dashpot, clock skew and step error free."""
    seen = trained[0].seen()
    stiffness = SMALL * seen.f / seen.x if law.spring else 0.0
    planned = LinearSpecimen(stiffness=stiffness, damping=SMALL * seen.f / seen.v)
    component = Specimen("specimen:1", (planned, ClockSkew(), StepError()))
    count = len(component.base)
    known: dict[Any, Any] = {type(part): part for part in before.parts[count:]} if before else {}
    begun = before.parts[:count] if before else component.base
    parts = [*begun, *(known.get(type(one), one) for one in law.effects)]
    masks = tuple(_inner(one) for one in trained)
    ones = tuple(np.ones(one.measured.shape) for one in trained)
    recordings = first_noise(Recordings(component, tuple(trained), masks, (Noise.white(1.0),), ones, ones))
    component.settle(parts, trained)
    return component, fit(recordings, parts)


def _compared(component: Specimen, fitted: Fitted, data: SpecimenData) -> tuple[Array, Array]:
    inside = _inner(data)
    return data.measured[0, inside], component.predicted(fitted.parts, data)[0, inside]


def _inner(data: SpecimenData) -> Any:
    place = np.arange(data.measured.shape[1]) * data.step
    return (place >= ENDS) & (place < place[-1] - ENDS)
