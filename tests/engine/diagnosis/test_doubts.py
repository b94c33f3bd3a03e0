"""What speaks against an effect of the selected model."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from rths_engine.diagnosis.doubts import claimed, doubtful, seen_by, unconfirmed
from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.proof import Proof, effects_of
from rths_engine.diagnosis.select import Selection
from tests.engine.diagnosis.made import DT, Driven, Gain, Wave, linear, noisy, recordings, selected

COUNT = 2000


def made(seed: int, *waves: tuple[float, int]) -> Driven:
    return noisy([Gain(), *(Wave(size=size, storey=storey) for size, storey in waves)], seed, COUNT)


def selection(data: Driven, *storeys: int, wide: float = 0.1) -> Selection:
    used = replace(recordings(linear(), data), masks=(inner(COUNT, DT),))
    chosen = fit(used, [Gain(), *(Wave(size=0.3, storey=storey) for storey in storeys)])
    ends = tuple((float(z) - wide * abs(float(z)), float(z) + wide * abs(float(z))) for z in chosen.z)
    return selected(used, fit(used, [Gain()]), chosen, ranges=ends)


def doubted(found: Selection, heldout: Driven) -> Any:
    proof = Proof.of(found, HeldOut.of(found.recordings, (heldout,)))
    gains = {(Wave, one.storey): proof.gain(found, one) for one in effects_of(found)}  # type: ignore[attr-defined]
    return doubtful(found, proof, gains)


def test_nothing_speaks_against_an_effect_that_all_data_have() -> None:
    assert doubted(selection(made(1, (0.5, 4)), 4), made(2, (0.5, 4))) is None


def test_held_out_data_without_the_effect_refute_it() -> None:
    assert "better without it" in doubted(selection(made(3, (0.5, 4)), 4), made(4)).reason


def test_an_only_size_whose_interval_reaches_zero_says_nothing() -> None:
    assert "includes zero" in doubted(selection(made(5, (0.5, 4)), 4, wide=1.0), made(6, (0.5, 4))).reason


def test_an_effect_without_a_clear_gain_stays_in_the_model() -> None:
    found = selection(made(7, (0.5, 4)), 4)
    (effect,) = claimed(found)
    refused = unconfirmed(effect, Proof.of(found, HeldOut.of(found.recordings, (made(8, (0.5, 4)),))).gain(found, effect))
    assert refused.contradicted is None and "stays in the extended model" in refused.reason


@pytest.mark.parametrize("storey", [1, 4])
def test_an_effect_is_told_the_amplitudes_of_its_storey(storey: int) -> None:
    found = selection(made(9, (0.5, storey)), storey)
    assert seen_by(found, effects_of(found)[0]).storey == storey
