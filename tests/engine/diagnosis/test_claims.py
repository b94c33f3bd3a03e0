"""The proof of claims: what is confirmed, what is rejected and why."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.claims import Claims, proved
from rths_engine.diagnosis.detect import Detection
from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.gain import Gain as HeldOutGain
from rths_engine.parts import physics
from tests.engine.diagnosis.made import DT, Driven, Gain, Wave, linear, noisy, recordings, selected

COUNT = 2000
QUIET = Detection(np.zeros(0), 0.0, 1.0, 1.0, 1.0, 3.0, 3.0)


def claims(fitted: Driven, heldout: tuple[Driven, ...], *storeys: int) -> Claims:
    """The proof of the waves of the `storeys`, fitted to one recording, on others."""
    used = replace(recordings(linear(), fitted), masks=(inner(COUNT, DT),))
    chosen = fit(used, [Gain(), *(Wave(size=0.3, storey=storey) for storey in storeys)])
    ends = tuple((float(z) - 0.1 * abs(float(z)), float(z) + 0.1 * abs(float(z))) for z in chosen.z)
    more: dict[str, Any] = {"ranges": ends, "detections": (QUIET,) * (1 + len(storeys))}
    return proved(selected(used, fit(used, [Gain()]), chosen, **more), heldout, np.random.default_rng(0))


def made(seed: int, *waves: tuple[float, int]) -> Driven:
    return noisy([Gain(), *(Wave(size=size, storey=storey) for size, storey in waves)], seed, COUNT)


def test_an_effect_that_every_recording_has_is_confirmed_and_explains_the_error() -> None:
    found = claims(made(1, (0.5, 4)), (made(2, (0.5, 4)),), 4)
    (claim,) = found.claims
    assert claim.gain.clear and claim.gain.other_motion and claim.share == pytest.approx(1.0, abs=0.05)
    assert found.remaining is not None and found.remaining < 0.1 and not found.part_of_it and not found.replicated


def test_each_effect_has_the_gain_of_its_own() -> None:
    found = claims(made(3, (0.5, 4), (0.2, 3)), (made(4, (0.5, 4), (0.2, 3)),), 4, 3)
    gains = {claim.effect.storey: claim.gain.mean for claim in found.claims}  # type: ignore[attr-defined]
    assert gains[4] > 2 * gains[3] > 0


def test_an_effect_that_another_recording_does_not_have_is_rejected() -> None:
    found = claims(made(5, (0.5, 4)), (made(6),), 4)
    assert found.claims == () and "better without it" in found.rejected[0].reason
    assert found.selection.effects == ()


def test_a_rejected_effect_leaves_the_others_refitted() -> None:
    found = claims(made(7, (0.5, 4), (0.3, 2)), (made(8, (0.5, 4)),), 4, 2)
    assert [claim.effect.storey for claim in found.claims] == [4]  # type: ignore[attr-defined]
    assert len(found.rejected) == 1 and len(found.selection.ranges) == len(found.selection.chosen.free)


def test_an_effect_that_is_not_confirmed_stays_in_the_model_without_a_name() -> None:
    """It is in one of two recordings, half as large as where it was fitted."""
    found = claims(made(17, (0.5, 4), (0.06, 2)), (made(18, (0.5, 4), (0.036, 2)),), 4, 2)
    assert [claim.effect.storey for claim in found.claims] == [4]  # type: ignore[attr-defined]
    assert "stays in the extended model" in found.rejected[0].reason and len(found.selection.effects) == 2
    assert found.undecided


def test_an_effect_of_unclear_gain_that_explains_much_is_named_with_doubt(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(HeldOutGain, "clear", False)
    (claim,) = claims(made(19, (0.5, 4)), (made(20, (0.5, 4)),), 4).claims
    assert claim.facts.doubted and claim.probability <= 0.45


def test_effects_of_which_none_is_probable_are_a_part_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rths_engine.diagnosis.claims.probability", lambda facts: 0.3)
    found = claims(made(21, (0.5, 4)), (made(22, (0.5, 4)),), 4)
    assert found.part_of_it and found.claims[0].facts.part_of_it


def test_two_recordings_that_agree_replicate_the_effect() -> None:
    heldout = (made(9, (0.5, 4)), made(10, (0.5, 4)))
    assert claims(made(11, (0.5, 4)), heldout, 4).replicated


def test_where_most_of_the_error_remains_the_effect_is_a_part_of_it() -> None:
    """Another wave, three times as large, is in all recordings and in no model."""
    found = claims(made(12, (0.3, 4), (1.0, 1)), (made(13, (0.3, 4), (1.0, 1)),), 4)
    assert found.part_of_it and found.remaining is not None and found.remaining > 0.5
    assert all(claim.probability < 0.5 for claim in found.claims)


def test_a_reading_that_the_recording_contradicts_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(physics.SEARCHES[Wave], "contradicted", lambda *given: "a third of the samples exceed it")
    found = claims(made(14, (0.5, 4)), (made(15, (0.5, 4)),), 4)
    assert found.claims == () and found.rejected[0].contradicted == "a third of the samples exceed it"


def test_without_another_recording_the_motion_is_the_same() -> None:
    data = made(16, (0.5, 4))
    used = replace(recordings(linear(), data), masks=(inner(COUNT, DT) & (np.arange(COUNT) % 500 < 350),))
    chosen = fit(used, [Gain(), Wave(size=0.3, storey=4)])
    ends = tuple((float(z) - 0.1, float(z) + 0.1) for z in chosen.z)
    selection = selected(used, fit(used, [Gain()]), chosen, ranges=ends, detections=(QUIET, QUIET))
    found = proved(selection, (), np.random.default_rng(0))
    (claim,) = found.claims
    assert not claim.gain.other_motion and claim.probability <= 0.8
