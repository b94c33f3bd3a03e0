"""What a recording holds beyond its plan's models: found, named and sized; nothing where there is nothing."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

from app.reports import html
from app.reports.diagnosis import document
from rths_engine.diagnosis.noise import FREQUENCY, coloured
from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.verdict import diagnose
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.specimen.asymmetry import Asymmetry
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.measured import Measured, MeasuredChannel
from tests.engine.recorded_specimens import BASELINE, plan, recording


def test_a_clean_recording_is_not_accused_of_anything() -> None:
    found = diagnose(plan(), recording(1))
    assert found.verdict.verdict == "recalibrate"  # 4 % off its plan
    assert found.verdict.effects == () and found.verdict.extended_plan is None
    fitted: Any = found.judged[0].selection.chosen.parts[0]
    assert fitted.stiffness == pytest.approx(1.04 * BASELINE.stiffness, rel=0.02)  # 1 % noise over 12 s
    assert fitted.damping == pytest.approx(0.96 * BASELINE.damping, rel=0.02)


@pytest.mark.parametrize(
    ("effect", "size", "rel"),
    [
        (Backlash(gap=0.002), "gap", 0.05),
        (Asymmetry(share=0.05), "share", 0.1),
        (CoulombFriction(friction=1.5e4, presliding=5e-4), "friction", 0.1),
    ],
    ids=lambda value: getattr(value, "kind", None),
)
def test_what_was_left_out_is_named_sized_and_shown_on_another_recording(effect: Effect, size: str, rel: float) -> None:
    found = diagnose(plan(), recording(2, effect), [recording(3, effect, amplitude=0.03)]).verdict
    json.dumps(found.as_dict(), allow_nan=False)
    assert found.verdict == "mismatch" and found.where and found.where.component == "specimen:1"
    assert [(one.component, one.id) for one in found.effects] == [("specimen:1", effect.id)]
    number = next(one for one in found.effects[0].parameters if one.name == size)
    assert number.value == pytest.approx(getattr(effect, size), rel=rel)
    assert number.ci90[0] < number.value < number.ci90[1]
    before, after, noise = found.fit.baseline.heldout_nrmse, found.fit.extended.heldout_nrmse, found.fit.noise_floor_nrmse
    assert before and after and noise
    assert after < 1.2 * noise and after < 0.5 * before
    again = read_plan(found.extended_plan)
    assert getattr(again.stations[0].specimen_physics[0], size) == number.value
    assert sum(one.probability for one in found.candidates) <= 1 + 1e-9


def test_a_law_outside_the_library_is_called_unknown_and_described() -> None:
    plain = recording(4)
    x = plain.get("x_meas")
    cogging = 0.05 * np.std(plain.get("f_meas")) * np.sin(2 * np.pi * x / 0.013)
    diagnosis = diagnose(plan(), _with(plain, f_meas=plain.get("f_meas") + cogging))
    found = diagnosis.verdict
    assert found.verdict == "mismatch"
    assert [(one.id, one.probability) for one in found.effects] == [("unknown", None)]
    left = found.unexplained
    assert left.formula and left.words in found.effects[0].sentence
    assert left.unit == "N" and left.size == pytest.approx(float(np.std(cogging)), rel=0.2)
    assert left.formula_share is not None and 0.5 < left.formula_share <= 1.0 and left.times_s and left.bands_hz
    assert found.next_test is not None and found.next_test.tells and found.next_test.amplitude
    (surface,) = pictures(diagnosis).components[0].detail.surfaces  # type: ignore[union-attr]
    assert sum(map(sum, surface.samples)) > 900 and surface.output.unit == "N"
    report = html.light(document("Cogging", [], found, pictures(diagnosis), plan().as_dict()))
    assert "Unexplained force over displacement and velocity" in report and found.next_test.tells in report


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"x_meas": 1e-3}, "Check the units"),
        ({"f_meas": 1e3}, "Check the units"),
    ],
)
def test_units_off_by_a_thousand_are_refused_before_anything_is_fitted(changed: dict[str, float], said: str) -> None:
    plain = recording(5)
    with pytest.raises(RecordingError, match=said):
        diagnose(plan(), _with(plain, **{role: factor * plain.get(role) for role, factor in changed.items()}))


def test_a_recording_of_another_plan_is_refused_with_its_reason() -> None:
    plain = recording(6)
    moved = tuple(MeasuredChannel(one.role, 2, one.values, one.unit) for one in plain.channels)
    with pytest.raises(RecordingError, match="has a channel of station 2; the number of stations in the plan is 1"):
        diagnose(plan(), Measured(plain.dt, moved))
    with pytest.raises(RecordingError, match="is of a 'structure' test"):
        diagnose(plan(), Measured(plain.dt, plain.channels, test="structure"))
    few = tuple(MeasuredChannel(one.role, 1, one.values[:100], one.unit) for one in plain.channels)
    with pytest.raises(RecordingError, match="has 100 samples"):
        diagnose(plan(), Measured(plain.dt, few))
    with pytest.raises(RecordingError, match="has no component with recorded signals at both ends"):
        diagnose(plan(), Measured(plain.dt, plain.channels[:1]))


def test_the_colour_of_noise_is_found() -> None:
    random = np.random.default_rng(3)
    noise = coloured([lfilter([2.0], [1, -0.8], random.standard_normal(20_000))])
    true = 4.0 / np.abs(1 - 0.8 * np.exp(-2j * np.pi * FREQUENCY)) ** 2
    assert noise.spectrum[40:] == pytest.approx(true[40:], rel=0.15)  # below, few waves were heard
    assert np.std(noise.drawn(20_000, random)) == pytest.approx(noise.deviation, rel=0.05)
    assert noise.deviation == pytest.approx(2.0 / 0.6, rel=0.05)


def _with(plain: Measured, **changed: Any) -> Measured:
    channels = tuple(MeasuredChannel(one.role, 1, changed.get(one.role, one.values), one.unit) for one in plain.channels)
    return Measured(plain.dt, channels)
