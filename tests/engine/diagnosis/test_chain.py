"""Actuator and specimen between a command and a force."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.components import Chain, ChainData, ClockSkew, StepError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.actuator.gain_error import GainError
from rths_engine.parts.physics.specimen.parallel_stiffness import ParallelStiffness
from rths_engine.parts.specimens.linear import LinearSpecimen

DT = 1 / 128
TIME = DT * np.arange(1280)
OMEGA = 2 * np.pi * 0.8
COMMAND = 0.02 * np.sin(OMEGA * TIME)
DELAY, SPRING = FirstOrderDelay(alpha=3.0), LinearSpecimen(stiffness=2e6, damping=0.0)
CHAIN = Chain("specimen:1", (DELAY, SPRING, ClockSkew(), StepError()))
INSIDE = slice(200, -30)  # once the delay's transient is gone


def data() -> ChainData:
    return ChainData(DT, 0.0, True, COMMAND, COMMAND, SPRING.stiffness * COMMAND)


def test_the_force_is_the_springs_at_what_the_actuator_reaches() -> None:
    """A first-order lag of tau = (alpha - 1) dt, in discrete time a / (1 - (1 - a) e^(-i w dt)) with a = 1 / alpha."""
    a = 1 / DELAY.alpha
    response = a / (1 - (1 - a) * np.exp(-1j * OMEGA * DT))
    reached = 0.02 * np.abs(response) * np.sin(OMEGA * TIME + np.angle(response))
    found = CHAIN.predicted([DELAY, SPRING], data())[0]
    assert found[INSIDE] == pytest.approx(SPRING.stiffness * reached[INSIDE], abs=1e-6 * SPRING.stiffness * 0.02)


def test_effects_of_the_actuator_act_before_those_of_the_specimen() -> None:
    """A gain of 1 + e before a spring of k + k_p."""
    plain = CHAIN.predicted([DELAY, SPRING], data())
    both = CHAIN.predicted([DELAY, SPRING, GainError(share=0.1), ParallelStiffness(stiffness=1e6)], data())
    assert both == pytest.approx(1.1 * 1.5 * plain, rel=1e-9)


def test_each_effect_is_of_the_component_it_acts_in() -> None:
    assert CHAIN.place(GainError(share=0.1)) == "actuator:1"
    assert CHAIN.place(ParallelStiffness(stiffness=1.0)) == "specimen:1"


def test_planned_actuators_have_a_tolerance_and_specimens_none() -> None:
    assert CHAIN.spread(DELAY) == 0.05 and CHAIN.spread(SPRING) is None and CHAIN.spread(ClockSkew()) == 0.25


def test_effects_of_both_are_looked_for_but_none_of_a_current_that_nobody_measured() -> None:
    found = {one.id for one in CHAIN.hypotheses(data())}
    assert {"delay_error", "coulomb_friction", "offset"} <= found and "current_lag" not in found


def test_terms_and_signals_are_of_the_command() -> None:
    x, _ = CHAIN.signals(data())
    assert x.values == pytest.approx(COMMAND)
    assert {one.response.shape for one in CHAIN.features([DELAY, SPRING], data())} == {data().measured.shape}
