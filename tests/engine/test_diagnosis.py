"""What a recording of a specimen holds beyond its model: found, named and sized; nothing where there is nothing."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from rths_engine import replay
from rths_engine.diagnosis.component import Specimen, SpecimenData
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.noise import Noise, autoregressive
from rths_engine.diagnosis.select import Selection, select
from rths_engine.physics.effect import Effect
from rths_engine.physics.specimen.asymmetry import Asymmetry
from rths_engine.physics.specimen.backlash import Backlash
from rths_engine.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.shapes import BandNoise
from rths_engine.specimens.linear import LinearSpecimen

DT, DURATION = 1 / 512, 12.0
BASELINE = LinearSpecimen(stiffness=2.0e6, damping=8.0e5)


def diagnosed(seed: int, *left_out: Effect) -> Selection:
    """A recording with coloured noise of 1 % on the force and 10 um on the displacement, of a specimen 4 % off its plan."""
    random = np.random.default_rng(seed)
    time = np.arange(int(DURATION / DT)) * DT
    x = 0.04 * BandNoise(low_frequency=0.1, high_frequency=2.5, duration=DURATION, seed=seed).sample(time)
    true = BASELINE.model_copy(update={"stiffness": 1.04 * BASELINE.stiffness, "damping": 0.96 * BASELINE.damping})
    force = replay.specimen(true, left_out, x, np.ones(len(x)), DT)
    coloured = lfilter([np.sqrt(1 - 0.81)], [1, -0.9], random.standard_normal(len(x)))
    measured = force + 0.01 * np.std(force) * coloured
    data = SpecimenData(x + 1e-5 * random.standard_normal(len(x)), measured, np.ones(len(x)), DT)
    count = len(data.band.reduced(data.force))
    everything = np.ones(count, dtype=bool)
    recordings = Recordings(Specimen("specimen:1", BASELINE), (data,), (everything,), Noise(np.ones(1), 1.0))
    return select(recordings, 0.01, np.random.default_rng(seed))


def test_a_clean_recording_is_not_accused_of_anything() -> None:
    found = diagnosed(1)
    assert found.effects == ()
    fitted = found.chosen.parts[0]
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
def test_what_was_left_out_is_named_and_sized(effect: Effect, size: str, rel: float) -> None:
    found = diagnosed(2, effect)
    assert [type(one) for one in found.effects] == [type(effect)]
    assert getattr(found.effects[0], size) == pytest.approx(getattr(effect, size), rel=rel)
    assert found.chosen.bic < found.baseline.bic - 6


def test_the_colour_of_noise_is_found() -> None:
    random = np.random.default_rng(3)
    noise = autoregressive(lfilter([2.0], [1, -0.8], random.standard_normal(20_000)), order=1)
    assert noise.coefficients[1] == pytest.approx(-0.8, abs=0.02)
    assert noise.sigma == pytest.approx(2.0, rel=0.03)
    assert noise.deviation == pytest.approx(2.0 / 0.6, rel=0.05)
