"""The gain of each effect of a selected model on held-out data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.proof import Proof, effects_of, left_out, planned_parts
from rths_engine.diagnosis.select import Selection
from tests.engine.diagnosis.made import DT, Driven, Gain, Wave, linear, noisy, recordings, selected

COUNT = 2000


def made(seed: int, size: float) -> Driven:
    return noisy([Gain(), Wave(size=size, storey=4)], seed, COUNT)


def selection(size: float) -> Selection:
    used = replace(recordings(linear(), made(1, size)), masks=(inner(COUNT, DT),))
    return selected(used, fit(used, [Gain()]), fit(used, [Gain(), Wave(size=0.3, storey=4)]))


def test_without_its_only_effect_the_model_is_the_refitted_plan() -> None:
    found = selection(0.5)
    (effect,) = effects_of(found)
    (rest,) = left_out(found, effect)
    assert isinstance(rest, Gain) and isinstance(found.baseline.parts[0], Gain)
    assert rest.gain == pytest.approx(found.baseline.parts[0].gain, rel=1e-3)
    assert planned_parts(found) is found.baseline.parts


def test_the_gain_of_an_effect_comes_from_the_held_out_data() -> None:
    found = selection(0.5)
    proof = Proof.of(found, HeldOut.of(found.recordings, (made(2, 0.5),)))
    gain = proof.gain(found, effects_of(found)[0])
    assert gain.clear and gain.tested and gain.other_motion
    assert proof.heldout.error(proof.chosen) < 0.1 * proof.heldout.error(proof.planned)


def test_held_out_data_in_which_an_effect_is_faint_are_joined_with_the_fitted_ones() -> None:
    found = selection(0.03)
    short = noisy([Gain(), Wave(size=0.03, storey=4)], 3, 300)
    gain = Proof.of(found, HeldOut.of(found.recordings, (short,))).gain(found, effects_of(found)[0])
    assert not gain.other_motion and len(gain.by_set) == 2
    assert np.isfinite(gain.mean)
