"""Effects that a diagnosis names: their order, probability, numbers and sentence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.fitting import Fitted, fit
from rths_engine.diagnosis.judge import Judged, fitted_blocks
from rths_engine.diagnosis.named import configuration_error, models, named
from rths_engine.diagnosis.unknown import Law
from tests.engine.diagnosis.made import DT, SAMPLES, Gain, Wave, as_judged, linear, noisy, recordings, selected

WHOLE = recordings(linear(), noisy([Gain(), Wave(size=0.5, storey=1), Wave(size=2.0, storey=2)], 1))
USED = replace(WHOLE, masks=(fitted_blocks(SAMPLES, DT),))


def fitted(*storeys: int) -> Fitted:
    return fit(USED, [Gain(), *(Wave(size=0.3, storey=storey) for storey in storeys)])


def judged(unknown: bool = False) -> Judged:
    """Two effects chosen; three models tried with probabilities of 0.7, 0.2 and 0.1."""
    chosen, one, other = fitted(1, 2), fitted(1), fitted(2)
    ends = tuple((float(z) - 0.1, float(z) + 0.2) for z in chosen.z)
    more = {"tried": (chosen, one, other), "chances": (0.7, 0.2, 0.1), "ranges": ends}
    return as_judged(selected(USED, fitted(), chosen, **more), unknown=unknown)


def test_an_effect_is_as_probable_as_the_models_that_hold_it_and_the_most_probable_comes_first() -> None:
    found = named(judged(), None)
    assert [one.id for one in found] == ["wave_1", "wave_2"]
    assert [one.probability for one in found] == pytest.approx([0.9, 0.8])


def test_the_interval_is_in_the_unit_of_the_number() -> None:
    one = judged()
    (size,) = named(one, None)[0].parameters
    free = one.selection.chosen.free[1]
    assert size.value == pytest.approx(0.5, abs=0.1)
    low, high = one.selection.ranges[1]
    assert size.ci90 == pytest.approx((low * free.scale, high * free.scale), rel=1e-12)  # z is the value over its scale


def test_the_sentence_says_what_the_effect_does_and_what_its_model_gains() -> None:
    one = judged()
    before, after = (100 * one.nrmse(model.parts, False) for model in (one.selection.baseline, one.selection.chosen))
    sentence = named(one, None)[0].sentence
    assert sentence.startswith("The specimen of station 1 adds a wave of")
    assert f"is {before:.3g} % with the planned model and {after:.3g} % with the extended model" in sentence


def test_models_are_told_by_their_component_and_effect() -> None:
    one = judged()
    assert [models(one, model) for model in one.selection.tried] == [
        ["specimen:1/wave_1", "specimen:1/wave_2"],
        ["specimen:1/wave_1"],
        ["specimen:1/wave_2"],
    ]


def test_what_has_no_name_is_unknown_with_the_law_in_words_and_no_probability() -> None:
    (found,) = named(judged(unknown=True), Law("x^2", "even in displacement", 0.9))
    assert (found.id, found.probability, found.parameters) == ("unknown", None, ())
    assert "even in displacement" in found.sentence


@pytest.mark.parametrize(("error", "said"), [(0.0123, "1.23 % of the largest"), (float(np.inf), "diverges")])
def test_a_computed_part_that_does_not_replay_is_a_configuration_error(error: float, said: str) -> None:
    found = configuration_error(Replayed("structure", error, error, "the command of damper 1"))
    assert (found.component, found.id, found.probability) == ("structure", "configuration_error", None)
    assert said in found.sentence and "the command of damper 1" in found.sentence
