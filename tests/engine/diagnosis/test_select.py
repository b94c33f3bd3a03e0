"""Which effects are chosen, where only a joint fit tells them apart, where there are two, and where there is none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.select import MOST_EFFECTS, Selection, select
from rths_engine.foundation.arrays import Array
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from tests.engine.diagnosis.made import SIGMA, Driven, Gain, Linear, Wave, WaveSearch, drive, driven, linear, noisy, recordings

COUNT = 800


def chosen(selection: Selection) -> dict[str, float]:
    return {part.id: part.size for part in selection.effects if isinstance(part, Wave)}


def selection_of(component: Linear, *data: Driven) -> Selection:
    return select(recordings(component, *data), 0.01, np.random.default_rng(1))


class Trapped(Wave):
    """A = x + 0.3 e is what was left out; D = e + 0.45 w resembles what a fitted gain leaves of it more than A does itself."""

    def output(self, x: Array) -> Array:
        e, w = (np.abs(x) - np.mean(np.abs(x)), np.cos(np.linspace(0, 40, len(x))))
        shapes = {1: x + 0.3 * e, 2: e + 0.45 * w}
        found: Array = self.size * shapes[self.storey]
        return found


physics.SEARCHES[Trapped] = WaveSearch(Trapped)


@dataclass(frozen=True)
class Trap(Linear):
    def hypotheses(self, data: Driven) -> Iterator[Effect]:
        yield Trapped(size=0.3, storey=1)
        yield Trapped(size=0.3, storey=2)

    def features(self, parts: Sequence[Any], data: Driven, like: Any = None) -> list[Any]:
        return []


def test_an_effect_that_the_baseline_hides_is_chosen_by_the_joint_fit() -> None:
    """The residual of the fitted gain looks like the decoy: by a cosine of 0.9 beside one of 0.3."""
    x = drive(COUNT)
    data = driven(2 * x + Trapped(size=1.0, storey=1).output(x) + SIGMA * np.random.default_rng(2).standard_normal(COUNT), x)
    residual = data.out - x * (x @ data.out) / (x @ x)

    def cosine(storey: int) -> float:
        shape = Trapped(size=1.0, storey=storey).output(x)
        return float(shape @ residual / np.linalg.norm(shape) / np.linalg.norm(residual))

    assert cosine(2) > 2 * abs(cosine(1))  # the trap is one
    found = selection_of(Trap("specimen:1", (Gain(gain=2.0),)), data)
    assert [(type(part), part.storey) for part in found.effects] == [(Trapped, 1)]  # type: ignore[attr-defined]
    assert found.chances[0] > 0.99


def test_nothing_is_chosen_where_nothing_was_left_out() -> None:
    found = selection_of(linear(), noisy([Gain(gain=2.1)], 3, COUNT))
    assert found.effects == () and found.chances == (1.0,) and len(found.detections) == 1


def test_two_effects_are_both_chosen_with_their_sizes() -> None:
    found = selection_of(linear(), noisy([Gain(gain=2.1), Wave(size=0.4, storey=2), Wave(size=-0.3, storey=4)], 4, COUNT))
    assert chosen(found) == pytest.approx({"wave_2": 0.4, "wave_4": -0.3}, abs=0.05)  # 5 SIGMA / sqrt(800 * 0.15)
    assert len(found.detections) == 3 and found.detections[-1].p_value > 0.01


def test_no_more_than_three_effects_are_chosen() -> None:
    waves = [Wave(size=1.0, storey=storey) for storey in (1, 2, 3, 4)]
    found = selection_of(linear(), noisy([Gain(), *waves], 5, COUNT))
    assert len(found.effects) == MOST_EFFECTS


def test_every_model_tried_is_ranked_by_its_chance_and_the_best_is_chosen() -> None:
    found = selection_of(linear(), noisy([Gain(), Wave(size=0.4, storey=3)], 6, COUNT))
    assert found.chosen is found.tried[0] and list(found.chances) == sorted(found.chances, reverse=True)
    assert sum(found.chances) == pytest.approx(1.0, rel=1e-12)
    kinds = [tuple(sorted(part.id for part in model.parts[1:])) for model in found.tried]  # type: ignore[attr-defined]
    assert len(set(kinds)) == len(kinds) and () in kinds
    assert len(found.ranges) == len(found.chosen.free)
    assert [part.gain for part in found.baseline.parts] == pytest.approx([2.0], abs=0.5)  # type: ignore[attr-defined]


def test_the_share_of_the_work_done_only_rises() -> None:
    heard: list[float] = []
    used = recordings(linear(), noisy([Gain(), Wave(size=0.4, storey=1)], 7, COUNT))
    select(used, 0.01, np.random.default_rng(1), heard.append)
    assert heard == sorted(heard) and heard[0] > 0 and heard[-1] < 1
