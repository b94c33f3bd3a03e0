"""What no named effect of a component explains: size, place, surface, formula, and the test that tells most about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.diagnosis.components import Structure
from rths_engine.diagnosis.exploring import Exploring, exploring
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.locate import Place, place
from rths_engine.diagnosis.surface import Surface, surfaces
from rths_engine.diagnosis.unknown import LEAST_SHARE, Law, law
from rths_engine.foundation.part import Part
from rths_engine.planning.plan import Plan


@dataclass(frozen=True)
class Remaining:
    """What no named effect of a component explains.

    `size` is the RMS beyond the noise in `unit` (N, or m for an actuator); for a structure, that of the storey force in the
    storey `at` where it is largest, and NaN where held-out data confirm the surface of no storey. `state_share` is the share of
    the held-out squared error beyond the noise that the surfaces explain; None where no error is left.
    """

    unit: str
    size: float
    at: str
    surfaces: tuple[Surface, ...]
    state_share: float | None
    law: Law | None
    place: Place
    test: Exploring | None

    @property
    def located(self) -> bool:
        """False for a structure whose surfaces held-out data do not confirm."""
        return bool(np.isfinite(self.size))

    @property
    def largest(self) -> Surface:
        """The surface of the place where the remaining force is largest."""
        return next(one for one in self.surfaces if one.place == self.at)


def remaining(plan: Plan, one: Judged, level: float) -> Remaining | None:
    """What no named effect of a component explains; None where the residual is noise or the named effects are the whole.

    Without a named effect, it is the residual of the planned model with refitted parameters.
    """
    last = one.selection.detections[-1]
    part = one.proof is not None and one.proof.part_of_it
    if one.verdict not in ("mismatch", "undetermined"):
        return None
    if not (one.unknown or part or one.verdict == "undetermined" or last.p_general <= level):
        return None
    model = one.selection.chosen if one.effects else one.selection.baseline
    found = tuple(surfaces(one.recordings, model.parts))
    share = _state_share(one, model.parts, found)
    at, size = _size(one, model.parts, found)
    if isinstance(one.component, Structure) and (share is None or share < LEAST_SHARE):
        at, size = "", float("nan")
    stroke, speed = 0.0, 0.0
    if plan.stations:
        limits = plan.stations[int(one.component.station or 1) - 1].limits
        stroke, speed = limits.displacement, limits.velocity
    return Remaining(
        "m" if one.component.output == "displacement" else "N",
        size,
        at,
        found,
        share,
        law(one.recordings, model, one.heldout),
        place(one, model.parts),
        exploring(one.recordings, found, stroke, speed),
    )


def _size(one: Judged, parts: Sequence[Part], found: Sequence[Surface]) -> tuple[str, float]:
    """The place with the largest remaining force and its RMS."""
    if isinstance(one.component, Structure):
        sizes = [_rms(surface) for surface in found]
        largest = int(np.argmax(sizes))
        return found[largest].place, sizes[largest]
    left = np.concatenate(
        [row[0, mask] for row, mask in zip(one.recordings.residuals(parts), one.recordings.masks, strict=True)]
    )
    noise = one.recordings.noises[0].deviation
    return "", float(np.sqrt(max(0.0, float(np.mean(left**2)) - noise**2)))


def _rms(surface: Surface) -> float:
    """RMS of the force of a surface over its samples, without what its standard errors give."""
    known = np.isfinite(surface.mean) & np.isfinite(surface.error)
    if not known.any():
        return 0.0
    power = surface.mean[known] ** 2 - surface.error[known] ** 2
    return float(np.sqrt(max(0.0, float(np.average(power, weights=surface.samples[known])))))


def _state_share(one: Judged, parts: Sequence[Part], found: Sequence[Surface]) -> float | None:
    held = HeldOut.of(one.recordings, one.heldout)
    before = held.residuals(parts)
    beyond = held.error(before) - held.noise
    if beyond <= 0:
        return None
    after = []
    for data, mask in zip(held.data, held.masks, strict=True):
        states = one.component.states(data)
        added = [surface.at(state.x.values, state.v.values) for surface, state in zip(found, states, strict=True)]
        after.append(held.about_zero(data.measured - one.component.loaded(parts, data, added), mask))
    share = (held.error(before) - held.error(after)) / beyond
    return share if np.isfinite(share) else None
