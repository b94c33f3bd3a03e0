"""What there is to see of a diagnosis: whole, light, and true to the models."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.pictures import POINTS, pictures
from rths_engine.diagnosis.verdict import Diagnosis, diagnose
from rths_engine.parts.physics.specimen.backlash import Backlash
from tests.engine import recorded_specimens as made


@pytest.fixture(scope="module")
def played() -> Diagnosis:
    return diagnose(made.plan(), made.recording(1, Backlash(gap=0.002)), [made.recording(2, Backlash(gap=0.002))])


@pytest.fixture(scope="module")
def shown(played: Diagnosis) -> dict[str, Any]:
    return pictures(played).as_dict()


def test_every_component_is_shown_over_time_and_the_one_that_differs_in_detail(shown: dict[str, Any]) -> None:
    assert shown["schema"] == "rths-diagnosis-pictures/1"
    (specimen,) = (one for one in shown["components"] if one["component"] == "specimen:1")
    assert specimen["mismatch"] and max(specimen["over_time"]["level"]) > specimen["over_time"]["beyond"]
    (channel,) = specimen["detail"]["channels"]
    assert (channel["label"], channel["unit"], channel["shown"], channel["factor"]) == ("force", "N", "kN", 1000.0)


def test_the_blocks_held_out_are_the_engines_and_the_effect_explains_them(played: Diagnosis, shown: dict[str, Any]) -> None:
    detail = shown["components"][0]["detail"]
    assert not any(one["held_out"] for one in detail["blocks"])  # another recording is
    alone = pictures(diagnose(made.plan(), made.recording(1, Backlash(gap=0.002)))).as_dict()["components"][0]["detail"]
    held = [place for place, one in enumerate(alone["blocks"]) if one["held_out"]]
    assert held == [2, 5, 8]
    assert all(alone["blocks"][place]["after"] < 0.5 * alone["blocks"][place]["before"] for place in held)
    (other,) = detail["held_out_recordings"]
    fit = played.verdict.fit
    found = {"before": fit.baseline.heldout_nrmse, "after": fit.extended.heldout_nrmse}
    assert other == pytest.approx(found, rel=0.05)  # of all samples or of those beyond the filters' ends
    assert detail["noise_nrmse"] == pytest.approx(fit.noise_floor_nrmse, rel=1e-5)  # six digits


def test_residuals_are_what_the_simulations_leave_and_spectra_carry_their_power(shown: dict[str, Any]) -> None:
    detail = shown["components"][0]["detail"]
    state = {name: np.array(row) for name, row in detail["state"].items() if name not in ("axes", "output")}
    for model in ("before", "after"):
        left = state["measured"] - state[model]
        assert state[f"residual_{model}"] == pytest.approx(left, abs=2e-5 * np.ptp(state["measured"]))  # six digits of each
        spectrum = detail["channels"][0]["spectra"]
        step = spectrum["frequency_hz"][1] - spectrum["frequency_hz"][0]
        power = step * np.sum(spectrum[model])
        assert power == pytest.approx(np.var(left), rel=0.35)  # Welch tapers the ends of a record of twelve seconds
    assert len(detail["state"]["axes"]) == 2 and detail["state"]["axes"][1]["shown"] == "mm/s"


def test_the_noise_drawn_is_that_of_the_recording(shown: dict[str, Any]) -> None:
    spectrum = shown["components"][0]["detail"]["channels"][0]["spectra"]
    inside = slice(0, len(spectrum["frequency_hz"]) // 2)
    noise, after = (np.array(spectrum[name])[inside] for name in ("noise", "after"))
    ratio = float(np.exp(np.mean(np.log(after / noise))))
    assert 0.5 < ratio < 2.0  # the model of the noise is of twelve numbers, the spectrum of few segments


def test_pictures_are_light_and_hold_no_nan(shown: dict[str, Any]) -> None:
    text = json.dumps(shown, allow_nan=False)
    assert len(text) < 1e6
    for group in ("signals", "residuals"):
        for name, row in shown["components"][0]["detail"]["channels"][0][group].items():
            assert len(row) <= POINTS + 2, name  # and both ends


def test_a_clean_recording_shows_its_worst_component_in_detail() -> None:
    found = pictures(diagnose(made.plan(), made.recording(3), level=1e-9))
    (specimen,) = found.components
    assert not specimen.mismatch and specimen.detail is not None
