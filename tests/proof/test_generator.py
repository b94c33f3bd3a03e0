"""The generator against closed forms: sealed truths follow the equations."""

from __future__ import annotations

import numpy as np
import pytest

from tests.proof.generator import outside, specimen
from tests.proof.generator.draw_specimen import scales
from tests.proof.generator.laws import HyperbolicTangent, Linear, Slider, SliderMaxwell
from tests.proof.generator.left_out import BoucWen, Compliance, Drop, Heating, LuGre, Mass, Play, Series
from tests.proof.generator.motion import STEP, Motion, random_motion
from tests.proof.generator.noise import Colour
from tests.proof.generator.readings import Reading
from tests.proof.generator.sizing import Absorbed, sized
from tests.proof.generator.specimen_effects import CURRENT, IDS, effect

TIME = np.arange(0, 4.0, 1 / 256)
KNOTS = np.arange(0, 4.0 + STEP / 2, STEP)
RAMP = Motion(0.05 * KNOTS)  # 50 mm/s
WAVE = Motion(0.02 * np.sin(2 * np.pi * KNOTS))
SOLVED = 1e-6  # relative, of an integration at 1e-8


def test_a_motion_has_the_derivatives_of_its_displacement() -> None:
    x, v, a = WAVE(1.1)
    angle = 2 * np.pi * 1.1
    amplitude = 0.02 * np.array([np.sin(angle), 2 * np.pi * np.cos(angle), -4 * np.pi**2 * np.sin(angle)])
    assert [x, v, a] == pytest.approx(amplitude, rel=1e-7)  # a quintic spline with 512 knots a cycle
    assert [float(WAVE.sample(np.array([1.1]), k)[0]) for k in range(3)] == pytest.approx([x, v, a], rel=1e-9)


def test_a_slider_maxwell_element_flows_at_its_strength() -> None:
    """At a constant speed V beyond yield, V = f/c + ((f - a)/b)^(1/n)."""
    law = SliderMaxwell(1e5, 1.5e5, 0.5, 1e8, 1e7)
    force = specimen.force(law, [], RAMP, TIME)[-1]
    assert force / 1e7 + ((force - 1e5) / 1.5e5) ** 2 == pytest.approx(0.05, rel=1e-5)


def test_a_slider_dissipates_its_parallelogram() -> None:
    law = Slider(1e5, 5e7)
    force, x = specimen.force(law, [], WAVE, TIME), WAVE.sample(TIME)
    cycle = slice(256, 513)
    work = np.trapezoid(force[cycle], x[cycle])
    assert work == pytest.approx(4 * 1e5 * (0.02 - 1e5 / 5e7), rel=2e-3)  # trapezoids over 256 samples with four corners


def test_a_compliance_before_a_dashpot_is_a_maxwell_element() -> None:
    """u' = f/c and x - u = phi f: over a ramp f = c V (1 - exp(-t / (c phi)))."""
    force = specimen.force(Linear(0.0, 5e5), [Compliance(1e-6)], RAMP, TIME)
    assert force == pytest.approx(5e5 * 0.05 * (1 - np.exp(-TIME / 0.5)), rel=SOLVED, abs=0.1)


def test_play_lets_nothing_through_until_it_is_taken_up() -> None:
    """Half of the gap at a ramp's start; then the dashpot's force, behind a contact that deforms by a micrometre."""
    force = specimen.force(Linear(0.0, 5e5), [Play(0.02, 2.5e10, 1e-7)], RAMP, TIME)
    assert np.max(np.abs(force[TIME < 0.1999])) < 1
    assert force[TIME > 0.25] == pytest.approx(5e5 * 0.05, rel=1e-3)


def test_heat_takes_force_exponentially_from_a_constant_one() -> None:
    """E' = f_0 (1 - phi E) V: f = f_0 exp(-phi f_0 V t)"""
    force = specimen.force(Linear(0.0, 1e6), [Heating(1e-4)], RAMP, TIME)
    assert force == pytest.approx(5e4 * np.exp(-1e-4 * 5e4 * 0.05 * TIME), rel=SOLVED)


def test_lugre_friction_ends_at_its_stribeck_curve() -> None:
    slow = LuGre(1e4, 1e-4, 2e4, 0.05)
    force = specimen.force(Linear(0.0, 0.0), [slow], RAMP, TIME)
    assert force[-1] == pytest.approx(1e4 * (1 + np.exp(-1.0)), rel=1e-5)


def test_bouc_wen_of_exponent_one_rises_exponentially() -> None:
    force = specimen.force(Linear(0.0, 0.0), [BoucWen(1e4, 0.01, 1.0, 0.5)], RAMP, TIME)
    assert force == pytest.approx(1e4 * (1 - np.exp(-5 * TIME)), rel=SOLVED, abs=0.01)


def test_effects_act_one_after_the_other() -> None:
    force = specimen.force(Linear(1e6, 0.0), [Mass(1e3), Drop(0.5, 2.0)], WAVE, TIME)
    plain = 1e6 * WAVE.sample(TIME) + 1e3 * WAVE.sample(TIME, 2)
    assert force == pytest.approx(np.where(TIME > 2.0, 0.5, 1.0) * plain, rel=1e-9, abs=1e-6)


def test_noise_has_the_spectrum_it_says() -> None:
    noise = Colour(3.0, 1 / 256, 20.0, 0.2)
    drawn = [noise.drawn(np.random.default_rng(seed), 4096) for seed in range(40)]
    assert np.mean(np.square(drawn)) == pytest.approx(9.0, rel=0.05)  # 40 draws of about 700 independent values
    energy = np.mean([float(np.sum(noise.whitened(one) ** 2)) for one in drawn])
    assert energy == pytest.approx(4096 * 50 / 128, rel=0.02)  # 40 draws of 1600, up to 50 Hz of 128


def test_lambda_is_what_the_baseline_can_not_take_up() -> None:
    """In white noise: the energy of the effect beside the baseline's own response, over sigma^2."""
    noise = Colour(100.0, 1 / 256, 1e6, 0.0)
    spring = WAVE.sample(TIME)
    absorbed = Absorbed(lambda numbers: [numbers["k"] * spring], {"k": 1e6}, [noise])
    beside = 50 * np.cos(6 * np.pi * TIME)
    assert absorbed.strength([1.1e6 * spring + beside]) == pytest.approx(float(beside @ beside) / 1e4, rel=1e-3)


LAW = HyperbolicTangent(1e5, 0.02, 0.05, 2e5, 8e4)
SCALE = scales(WAVE, specimen.force(LAW, [], WAVE, TIME), TIME) | {"current": 2.0, "temperature": 293.15}


def fallen(t: float) -> float:
    """A current (A) that rises, then falls, each within 20 ms as in the cases."""
    return float(np.interp(t, [0.5, 0.52, 0.8, 0.82], [1.0, 2.0, 2.0, 0.5]))


def test_a_size_that_cannot_be_solved_leaves_the_last_one_that_could() -> None:
    """lambda = 1e6 size^2 down to a size of 0.01, below which the equations are too stiff."""
    assert sized(lambda size: 1e6 * size**2 if size > 0.01 else np.inf, 1.0, 1.0, 2.0) == pytest.approx(1 / 30)
    assert sized(lambda size: 1e4 * size**2, 1.0, 1.0, 2.0) == pytest.approx(0.01)


@pytest.mark.parametrize("name", [*IDS, "sensor_offset", "sensor_clipping"])
def test_every_effect_vanishes_with_its_size(name: str) -> None:
    small, large = (effect(3, name, size, SCALE) for size in (1e-9, 0.2))
    assert small.id == large.id == name.removeprefix("sensor_")
    if isinstance(small.acts, Series) or small.component.startswith("sensor"):
        return  # a connection of no length is stiff beyond solving; sensors have tests of their own
    assert not isinstance(small.acts, Reading) and not isinstance(large.acts, Reading)
    plain = specimen.force(LAW, [], WAVE, TIME[:300])
    current = (lambda t: 1.0 + float(t > 0.5)) if name in CURRENT else specimen.steady
    current = fallen if name == "residual_field" else current
    temperature = (lambda t: 283.15 + 20 * t) if name == "strength_against_temperature" else specimen.mild
    without = specimen.force(LAW, [small.acts], WAVE, TIME[:300], current, temperature)
    assert without == pytest.approx(plain, abs=2e-6 * SCALE["f"])
    if name != "strength_drop":  # it drops after these
        shown = specimen.force(LAW, [large.acts], WAVE, TIME[:300], current, temperature)
        assert np.max(np.abs(shown - plain)) > 1e-3 * SCALE["f"]


@pytest.mark.parametrize("name", outside.NAMES)
def test_physics_outside_the_library_is_seen(name: str) -> None:
    acts = outside.drawn(np.random.default_rng(1), name, 0.2, SCALE)
    plain = specimen.force(LAW, [], WAVE, TIME[:300])
    assert np.max(np.abs(specimen.force(LAW, [acts], WAVE, TIME[:300]) - plain)) > 1e-4 * SCALE["f"]


@pytest.mark.parametrize("kind", ["earthquake", "noise", "sweep", "cycles"])
def test_a_drawn_motion_begins_and_ends_at_rest_and_never_jumps(kind: str) -> None:
    motion = random_motion(np.random.default_rng(2), kind, 0.03, 16.0)
    time = np.arange(0, 16.0, 1 / 256)
    x, v = motion.sample(time), motion.sample(time, 1)
    assert np.max(np.abs(x)) == pytest.approx(0.03, rel=1e-3)
    assert np.max(np.abs(v[(time < 0.9) | (time > 15.1)])) < 1e-6
    assert np.max(np.abs(np.diff(v))) < 0.25 * np.max(np.abs(v))
