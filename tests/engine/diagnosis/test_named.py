"""Effects that a diagnosis names: their order, probability, numbers and sentence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.claims import proved
from rths_engine.diagnosis.detect import Detection
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.doubts import Rejected
from rths_engine.diagnosis.fitting import Fitted, fit
from rths_engine.diagnosis.judge import Judged, fitted_blocks
from rths_engine.diagnosis.locate import Place
from rths_engine.diagnosis.named import configuration_error, models, named, rejected
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.diagnosis.surface import surfaces
from rths_engine.diagnosis.unknown import Law, Term
from tests.engine.diagnosis.made import DT, SAMPLES, Gain, Wave, as_judged, linear, noisy, recordings, selected

WHOLE = recordings(linear(), noisy([Gain(), Wave(size=0.5, storey=1), Wave(size=2.0, storey=2)], 1))
USED = replace(WHOLE, masks=(fitted_blocks(SAMPLES, DT),))


def fitted(*storeys: int) -> Fitted:
    return fit(USED, [Gain(), *(Wave(size=0.3, storey=storey) for storey in storeys)])


def judged(unknown: bool = False) -> Judged:
    """Two effects chosen; three models tried with probabilities of 0.7, 0.2 and 0.1."""
    chosen, one, other = fitted(1, 2), fitted(1), fitted(2)
    ends = tuple((float(z) - 0.1, float(z) + 0.2) for z in chosen.z)
    last = Detection(np.zeros(0), 0.0, 1.0, 1.0, 1.0, 3.0, 3.0)
    more = {"tried": (chosen, one, other), "chances": (0.7, 0.2, 0.1), "ranges": ends, "detections": (last,)}
    selection = selected(USED, fitted(), chosen, **more)
    proof = proved(selection, (), np.random.default_rng(0))
    return as_judged(proof.selection, unknown=unknown, proof=proof)


def test_every_effect_carries_its_own_probability_and_proof_and_the_most_probable_comes_first() -> None:
    one = judged()
    found = named(one, None)
    assert one.proof is not None and sorted(effect.id for effect in found) == ["wave_1", "wave_2"]
    assert {effect.probability for effect in found} == {claim.probability for claim in one.proof.claims}
    assert [effect.probability for effect in found] == sorted((effect.probability for effect in found), reverse=True)  # type: ignore[type-var]
    for effect in found:
        low, high = effect.gain_ci90  # type: ignore[misc]
        assert 0 < low < effect.gain < high and effect.blocks == 3 and not effect.other_motion  # type: ignore[operator]


def test_where_most_of_the_error_remains_the_unexplained_comes_first_and_the_effects_are_a_part_of_it() -> None:
    one = judged()
    assert one.proof is not None
    part = replace(one, proof=replace(one.proof, part_of_it=True, remaining=0.78))
    first, *others = named(part, None)
    assert first.id == "unknown" and "78 % of the held-out error beyond the noise remains" in first.sentence
    assert len(others) == 2
    assert all(effect.part_of_it and effect.sentence.startswith("Part of it: the specimen") for effect in others)


def test_a_rejected_effect_keeps_its_reason_and_its_gain() -> None:
    one = judged()
    assert one.proof is not None
    claim = one.proof.claims[0]
    refused = Rejected(claim.effect, "The recording contradicts this effect: 8 %.", "8 %", claim.gain)
    (found,) = rejected(replace(one, proof=replace(one.proof, rejected=(refused,))))
    assert (found.id, found.contradicted, found.gain) == (claim.effect.id, "8 %", claim.gain.mean)


def test_the_interval_is_in_the_unit_of_the_number() -> None:
    one = judged()
    (size,) = next(effect for effect in named(one, None) if effect.id == "wave_1").parameters
    free = one.selection.chosen.free[1]
    assert size.value == pytest.approx(0.5, abs=0.1)
    low, high = one.selection.ranges[1]
    assert size.ci90 == pytest.approx((low * free.scale, high * free.scale), rel=1e-12)  # z is the value over its scale


def test_each_sentence_says_what_its_effect_does_and_what_it_alone_gains() -> None:
    one = judged()
    assert one.proof is not None
    after = f"{100 * one.proof.errors[1]:.3g} % with it (3 blocks of the same motion)"
    for claim in one.proof.claims:
        sentence = next(effect.sentence for effect in named(one, None) if effect.id == claim.effect.id)
        assert sentence.startswith("The specimen of station 1 adds a wave of") and after in sentence
        assert f"is {100 * claim.error_without:.3g} % without this effect alone" in sentence


def test_models_are_told_by_their_component_and_effect() -> None:
    one = judged()
    told = [models(one, model) for model in one.selection.tried]
    assert told[0] == ["specimen:1/wave_1", "specimen:1/wave_2"]
    assert sorted(told[1:]) == [["specimen:1/wave_1"], ["specimen:1/wave_2"]]


def test_what_has_no_name_is_unknown_with_the_law_in_words_and_no_probability() -> None:
    one = judged(unknown=True)
    law = Law((Term(1200.0, "x^2", "even in displacement", "", None),), 0.9, 0.8)
    where = Place([(1.0, 2.0)], [(0.5, 3.0)], "", np.zeros(1), np.zeros(1))
    shape = tuple(surfaces(one.recordings, one.selection.baseline.parts))
    (found,) = named(one, Remaining("N", 1234.0, "", shape, 0.3, law, where, None))
    assert (found.id, found.probability, found.parameters) == ("unknown", None, ())
    assert "is 1.23 kN RMS, from 1.0 to 2.0 s, at 0.5 to 3 Hz" in found.sentence
    assert "even in displacement" in found.sentence and "explains 80 % of it on held-out data" in found.sentence
    assert "explains 30 % of it on held-out data; the rest changes within a cell" in found.sentence


@pytest.mark.parametrize(("error", "said"), [(0.0123, "1.23 % of the largest"), (float(np.inf), "diverges")])
def test_a_computed_part_that_does_not_replay_is_a_configuration_error(error: float, said: str) -> None:
    found = configuration_error(Replayed("structure", error, error, "the command of damper 1"))
    assert (found.component, found.id, found.probability) == ("structure", "configuration_error", None)
    assert said in found.sentence and "the command of damper 1" in found.sentence
