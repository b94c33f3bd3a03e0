"""Held-out residuals of a selected model without each of its effects, and the gain of each effect."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.gain import Blocks, Gain, Scale, gain
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.select import Selection, reduced
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.sensor.offset import ForceOffset
from rths_engine.parts.physics.sensor.time_skew import ForceTimeSkew

NUISANCES = (ForceOffset, ForceTimeSkew)  # free in every comparison: proved with the comparison's own zero and lag as they are


@dataclass(frozen=True)
class Proof:
    """Held-out residuals of the selected model, of the planned parts, of the model without each effect, and of rivals."""

    heldout: HeldOut
    blocks: Blocks
    scale: Scale
    chosen: list[Array]
    planned: list[Array]
    without: dict[Any, list[Array]]

    @classmethod
    def of(cls, selection: Selection, held: HeldOut) -> Proof:
        chosen = held.residuals(selection.chosen.parts)
        scale = Scale.of(held, held.whitened(chosen))
        without = {key(one): held.residuals(left_out(selection, one)) for one in effects_of(selection)}
        planned = held.residuals(planned_parts(selection))
        return cls(held, held.blocks(scale.memory), scale, chosen, planned, without)

    def gain(self, selection: Selection, effect: Effect) -> Gain:
        """The gain of an effect on the held-out data, or on all data where the held-out data alone cannot test it."""
        held = replace(self.heldout, zeros_free=False) if isinstance(effect, NUISANCES) else self.heldout
        rest = left_out(selection, effect)
        found = self._gain(selection.chosen.parts, rest, held)
        if found.tested:
            return found
        return self._gain(selection.chosen.parts, rest, held.with_fitted())

    def _gain(self, parts: Sequence[Part], rest: Sequence[Part], held: HeldOut) -> Gain:
        white, without = held.whitened(held.residuals(parts)), held.whitened(held.residuals(rest))
        scale = Scale.of(held, white)
        along = held.memory(white, [one - other for one, other in zip(without, white, strict=True)])
        return gain(replace(scale, memory=along), white, without, held.blocks(scale.memory), held.other_motion)


def effects_of(selection: Selection) -> list[Effect]:
    """The effects of the selected model."""
    return [one for one in selection.effects if isinstance(one, Effect)]


def left_out(selection: Selection, effect: Effect) -> Sequence[Part]:
    """The selected model without an effect, everything else refitted; nuisances could take the place of a nuisance and stay."""
    if isinstance(effect, NUISANCES):
        return [one for one in selection.chosen.parts if one is not effect]
    return reduced(selection, effect).parts


def planned_parts(selection: Selection) -> Sequence[Part]:
    """The refitted planned parts; those of the selected model where all its effects are nuisances."""
    effects = effects_of(selection)
    if effects and all(isinstance(one, NUISANCES) for one in effects):
        return selection.chosen.parts[: len(selection.recordings.component.base)]
    return selection.baseline.parts
