"""A specimen between displacement and force, beside a spring and a dashpot in closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.components import ClockSkew, Specimen, SpecimenData, StepError
from rths_engine.diagnosis.components.specimen import FINER, _late
from rths_engine.foundation.arrays import Array
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.mr_damper import MrDamper

RATE, FREQUENCY = 128.0, 0.8
DT = 1 / RATE
TIME = DT * np.arange(1280)
OMEGA = 2 * np.pi * FREQUENCY
X, V = 0.02 * np.sin(OMEGA * TIME), 0.02 * OMEGA * np.cos(OMEGA * TIME)
SPRING = LinearSpecimen(stiffness=2e6, damping=3e5)
FORCE = SPRING.stiffness * X + SPRING.damping * V
INSIDE = slice(30, -30)


def data(x: Array = X, force: Array = FORCE, **more: object) -> SpecimenData:
    """With a displacement that is taken as it is, without smoothing."""
    found = replace(SpecimenData(DT, 0.0, False, x, force, np.ones(len(x))), **more)  # type: ignore[arg-type]
    found.__dict__["smooth"] = x
    return found


def test_the_force_of_a_spring_and_dashpot_is_k_x_plus_c_v() -> None:
    """Steps of h: velocity half a step late, made good by a quarter, which the spring then lacks: (w h)^2 and k v h / 4."""
    component = Specimen("specimen:1", (SPRING,))
    h = DT / data().finer
    off = component.predicted([SPRING], data())[0] - FORCE
    bound = SPRING.stiffness * np.max(V) * h / 4 + SPRING.damping * OMEGA * np.max(V) * h / 4
    assert np.max(np.abs(off[INSIDE])) < 1.05 * bound
    assert bound < 0.002 * np.max(np.abs(FORCE))


def test_the_step_error_is_what_finer_steps_change_and_takes_most_of_it_away() -> None:
    """An error of first order h falls to h / 8 in steps an eighth as long: 8/7 of the change is the whole."""
    component = Specimen("specimen:1", (SPRING, ClockSkew(), StepError()))
    one = data()
    plain = component.predicted(component.base, one)[0] - FORCE
    component.settle(component.base, [one])
    settled = component.predicted(component.base, one)[0] - FORCE
    assert StepError().share == pytest.approx(FINER / (FINER - 1))
    assert np.std(settled[INSIDE]) < 0.05 * np.std(plain[INSIDE])


def test_a_run_of_the_loop_has_no_step_error() -> None:
    one = data(stepped=True)
    component = Specimen("specimen:1", (SPRING,))
    component.settle([SPRING], [one])
    assert one.step_error is None
    backward = SPRING.stiffness * X + SPRING.damping * np.diff(X, prepend=0.0) / DT
    assert component.predicted([SPRING], one)[0] == pytest.approx(backward, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("samples", [0.3, -0.7, 2.25])
def test_a_delay_by_a_fraction_of_a_sample_shifts_a_sine(samples: float) -> None:
    """A Kaiser window with a beta of 6 keeps errors 63 dB down: 7e-4."""
    sine = np.sin(2 * np.pi * 0.05 * np.arange(400))
    expected = np.sin(2 * np.pi * 0.05 * (np.arange(400) - samples))
    assert _late(sine[None], samples)[0][20:-20] == pytest.approx(expected[20:-20], abs=7e-4)


def test_a_clock_skew_reads_the_force_late() -> None:
    component = Specimen("specimen:1", (SPRING, ClockSkew()))
    late = component.predicted([SPRING, ClockSkew(delay=0.005)], data())[0]
    plain = component.predicted([SPRING], data())[0]
    assert late[INSIDE] == pytest.approx(np.interp(TIME - 0.005, TIME, plain)[INSIDE], abs=1e-3 * np.max(np.abs(plain)))


def test_the_force_before_the_start_is_told_where_it_stands_out_of_noise() -> None:
    random = np.random.default_rng(1)
    noise = 100.0 * random.standard_normal(len(X))
    assert data(force=noise + 1e4 * X).pressed == 0.0  # noise beside nothing
    held = FORCE[0] + 5e4 + 0 * X
    assert data(force=held + noise).pressed == pytest.approx(held[0], rel=0.01)


def test_sizes_seen_are_the_largest_and_the_energy_of_the_dashpot() -> None:
    """pi c w X^2 a cycle, of 8 cycles; |f v| counts the spring's work both ways too, so that it is more."""
    seen = data().seen()
    assert (seen.x, seen.v) == pytest.approx((0.02, 0.02 * OMEGA), rel=2e-3)
    assert seen.f == pytest.approx(np.hypot(SPRING.stiffness * 0.02, SPRING.damping * 0.02 * OMEGA), rel=2e-3)
    assert seen.energy == pytest.approx(np.mean(np.abs(FORCE * V)) * 10.0, rel=2e-3)
    assert seen.energy > np.pi * SPRING.damping * OMEGA * 0.02**2 * 8


def test_a_redrawn_displacement_has_noise_of_the_size_of_what_smoothing_leaves() -> None:
    random = np.random.default_rng(2)
    one = SpecimenData(DT, 0.0, False, X + 2e-5 * random.standard_normal(len(X)), FORCE, np.ones(len(X)))
    assert one.input_noise == pytest.approx(2e-5, rel=0.1)  # of a median of 1280 samples' powers
    left, drawn = np.std(one.smooth - X), np.std(one.redrawn(random).smooth - one.smooth)
    assert 0.5 < drawn / left < 2.0 and left < 2e-5


def test_a_thinned_displacement_keeps_every_second_sample_and_guesses_the_others() -> None:
    """A cubic spline through 80 samples a period: 5 / 384 (2 pi / 80)^4 of the amplitude, 5e-7."""
    thin = data().thinned()
    assert np.array_equal(thin.smooth[::2], X[::2])
    assert thin.smooth[INSIDE] == pytest.approx(X[INSIDE], abs=1e-6 * 0.02)


def test_only_where_the_actuators_motion_is_known_is_the_velocity_told_from_behind() -> None:
    assert data().behind() is not None and "fine" not in data().behind().__dict__
    known = data(expected=X)
    late = known.behind()
    # parabolas through three samples tell the slope of a sine to (w dt)^2 / 3, off at mid-sample by an eighth of dt of it
    assert late.fine[300:-300] == pytest.approx(known.fine[300:-300], abs=0.02 * OMEGA * DT * (OMEGA * DT) ** 2)


def test_effects_of_the_current_are_looked_for_only_where_it_varies() -> None:
    component = Specimen("specimen:1", (MrDamper(),))
    steady = {one.id for one in component.hypotheses(data())}
    varied = {one.id for one in component.hypotheses(data(current=1 + (TIME > 2)))}
    assert varied - steady == {"current_lag", "residual_field", "strength_against_current"}
    assert {"backlash", "coulomb_friction", "offset"} <= steady


def test_terms_of_an_unknown_law_are_in_the_band_of_the_comparison() -> None:
    terms = Specimen("specimen:1", (SPRING,)).features([SPRING], data())
    assert {one.response.shape for one in terms} == {data().measured.shape}
    assert {"x^3", "sgn(v)", "f cos(1 pi t / T)"} <= {one.formula for one in terms}
