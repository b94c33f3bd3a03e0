"""Contract of every part: what it declares, and that the compiled step is the Python step."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.kernel import fold
from rths_engine.foundation.part import validated
from rths_engine.parts import actuators, compensators, controllers, integrators, specimens, structures
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.structures.no_structure import NoStructure

DT = 1 / 1024
REGISTRIES = {"compensators": compensators, "actuators": actuators, "specimens": specimens, "controllers": controllers}
ALL_PARTS = [part for room in (*REGISTRIES.values(), integrators, structures) for part in room.KINDS]
PARTS = [(name, code) for name, registry in REGISTRIES.items() for code in range(len(registry.KINDS))]


@functools.cache
def dispatcher(registry: str) -> Any:
    return fold([kind.step for kind in REGISTRIES[registry].KINDS])


def inputs(registry: str, count: int) -> list[tuple[float, ...]]:
    rng = np.random.default_rng(3)
    x = np.cumsum(rng.normal(scale=2e-4, size=count))
    if registry == "compensators":
        return [(x[i], x[i - 1], 0.9 * x[i - 2], 1e-5 * x[i], DT) for i in range(2, count)]
    if registry == "actuators":
        return [(x[i], 4e6 * np.sin(i / 20)) for i in range(count)]
    if registry == "controllers":
        return [(x[i], (x[i] - x[i - 1]) / DT, 1e5 * np.sin(i / 20), DT) for i in range(1, count)]
    return [(x[i], DT) for i in range(count)]


@pytest.mark.parametrize(("registry", "code"), PARTS)
def test_compiled_step_equals_python_step(registry: str, code: int) -> None:
    part = REGISTRIES[registry].KINDS[code]
    dispatch = dispatcher(registry)
    parameters, state = part().build(DT)
    compiled_state = state.copy()
    for given in inputs(registry, 300):
        plain = part.step(parameters, state, *given)
        # pow differs by an ulp between compiled and Python
        assert dispatch(code, parameters, compiled_state, *given) == pytest.approx(plain, rel=1e-12, abs=1e-15)
    assert compiled_state == pytest.approx(state, rel=1e-12, abs=1e-15)


@pytest.mark.parametrize(
    "part",
    [part for room in (*REGISTRIES.values(), integrators, structures) for part in room.KINDS],
    ids=lambda part: part.__name__,
)
def test_every_part_says_its_kind_title_equation_and_the_unit_of_each_number(part: type[Any]) -> None:
    assert part.title and part.__doc__ and ("=" in part.__doc__ or part is NoStructure)
    schema = part.model_json_schema()["properties"]
    assert "const" in schema.pop("kind")
    for field in schema.values():
        assert "title" in field
        if field.get("type") != "boolean" and "$ref" not in field.get("items", {}):
            assert {"unit", "shown", "factor"} <= field.keys()


@pytest.mark.parametrize(("registry", "code"), [one for one in PARTS if one[0] != "controllers"])
def test_every_part_starts_at_rest(registry: str, code: int) -> None:
    part = REGISTRIES[registry].KINDS[code]
    zeros = [0.0] * len(inputs(registry, 3)[0])
    zeros[-1] = DT if registry != "actuators" else 0.0
    assert part.step(*part().build(DT), *zeros) == 0.0


def test_inverse_compensation_cancels_a_first_order_delay_of_the_same_alpha() -> None:
    actuator, compensator = FirstOrderDelay(alpha=30), InverseCompensation(alpha_es=30)
    (pa, sa), (pc, sc) = actuator.build(DT), compensator.build(DT)
    command = 0.01 * np.sin(2 * np.pi * np.arange(1024) * DT)
    moved = [
        FirstOrderDelay.step(pa, sa, InverseCompensation.step(pc, sc, command[i], command[i - 1], 0.0, 0.0, DT), 0.0)
        for i in range(1, 1024)
    ]
    assert moved == pytest.approx(command[1:], abs=1e-15)


def test_the_actuator_lags_a_ramp_by_alpha_minus_one_steps() -> None:
    parameters, state = FirstOrderDelay(alpha=30).build(DT)
    rate = 0.1
    for q in range(2000):
        moved = FirstOrderDelay.step(parameters, state, rate * q * DT, 0.0)
    assert rate * 1999 * DT - moved == pytest.approx(29 * rate * DT, rel=1e-9)


def test_the_actuator_moves_no_faster_than_its_velocity_limit() -> None:
    parameters, state = FirstOrderDelay(alpha=1, velocity_limit=0.5).build(DT)
    assert FirstOrderDelay.step(parameters, state, 1.0, 0.0) == pytest.approx(0.5 * DT)
    assert FirstOrderDelay.step(parameters, state, -1.0, 0.0) == pytest.approx(0.0)


def test_the_actuator_stalls_against_its_force_capacity_but_moves_with_the_force() -> None:
    parameters, state = FirstOrderDelay(alpha=2, force_limit=1e5).build(DT)
    assert FirstOrderDelay.step(parameters, state, 1e-4, 1.0e5) == 0.0
    assert FirstOrderDelay.step(parameters, state, -1e-4, 1.0e5) == pytest.approx(-0.5e-4)


def test_aic_integrates_the_indicator_by_the_trapezoidal_rule() -> None:
    part = AdaptiveInverseCompensation(alpha_es=1, kp=0.4e6, ki=0.04e6)
    parameters, state = part.build(DT)
    ti = 2e-6 * np.arange(1, 6)  # m^2
    for value in ti:
        AdaptiveInverseCompensation.step(parameters, state, 0.0, 0.0, 0.0, value, DT)
    integral = np.trapezoid(np.concatenate([[0.0], ti]), dx=DT)
    assert state[0] == pytest.approx(0.4e6 * ti[-1] + 0.04e6 * integral)


def test_linear_specimen_is_a_spring_and_a_dashpot() -> None:
    parameters, state = LinearSpecimen(stiffness=2e6, damping=3e4).build(DT)
    LinearSpecimen.step(parameters, state, 0.010, DT)
    assert LinearSpecimen.step(parameters, state, 0.011, DT) == pytest.approx(2e6 * 0.011 + 3e4 * 0.001 / DT)


@pytest.mark.parametrize("velocity", [0.002, 0.05, 0.4])
def test_mr_damper_at_constant_velocity_settles_on_its_force_velocity_law(velocity: float) -> None:
    part = MrDamper()
    parameters, state = part.build(DT)
    for q in range(1, 6000):
        force = MrDamper.step(parameters, state, velocity * q * DT, DT)

    def strength(slip: float) -> float:
        strong: float = part.yield_force + part.rate_coefficient * slip**part.rate_exponent
        return strong

    flows = velocity > part.yield_force / part.damping
    slip = brentq(lambda slip: velocity - strength(slip) / part.damping - slip, 0, velocity) if flows else 0.0
    assert force == pytest.approx(strength(slip) if flows else velocity * part.damping, rel=1e-6)


def test_mr_damper_below_yield_is_a_maxwell_element() -> None:
    part = MrDamper(stiffness=1e8, damping=1e7)
    parameters, state = part.build(DT)
    velocity, tau = 1e-3, 1e7 / 1e8
    forces = [MrDamper.step(parameters, state, velocity * q * DT, DT) for q in range(1, 200)]
    exact = 1e7 * velocity * (1 - np.exp(-np.arange(1, 200) * DT / tau))
    assert forces == pytest.approx(exact, rel=0.006)  # backward Euler, dt / (2 tau) = 0.5 %


def test_mr_damper_solves_its_implicit_step_to_rounding() -> None:
    part = MrDamper()
    rng = np.random.default_rng(1)
    k, c, a, b, n = part.stiffness, part.damping, part.yield_force, part.rate_coefficient, part.rate_exponent
    relax = 1 / (1 + k * DT / c)
    for _ in range(200):
        parameters, _ = part.build(DT)
        state = np.array([0.0, rng.uniform(-3e5, 3e5)])
        start, x = state[1], rng.normal(scale=1e-3)
        force = MrDamper.step(parameters, state, x, DT)
        trial = (start + k * x) * relax
        slip = (trial - force) / (k * DT * relax)
        if abs(trial) <= a:
            assert force == trial
        else:
            assert force == pytest.approx(np.sign(trial) * (a + b * abs(slip) ** n), rel=1e-9)


def test_mr_damper_dissipates_energy_in_every_closed_cycle() -> None:
    parameters, state = MrDamper().build(DT)
    x = 0.02 * np.sin(2 * np.pi * np.arange(4 * 1024) * DT)
    force = np.array([MrDamper.step(parameters, state, value, DT) for value in x])
    work = np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x))
    cycles = np.diff(work[1023::1024])
    assert (cycles > 0).all()
    assert 4 * 0.02 * 138.5e3 < cycles[-1] < 4 * 0.02 * (138.5e3 + 161.8e3)  # between the yield force and the strength at 1 m/s


@pytest.mark.parametrize(
    ("part", "field", "value", "message"),
    [
        (FirstOrderDelay, "alpha", 0.2, "alpha = 0.2: needs a value >= 1"),
        (FirstOrderDelay, "alpha", float("nan"), "finite number"),
        (InverseCompensation, "alpha_es", 0, "alpha_es = 0: needs a value >= 1"),
        (MrDamper, "rate_exponent", 2, "needs a value <= 1"),
        (LinearSpecimen, "damping", -1, "needs a value >= 0"),
        (LinearSpecimen, "damping", "5 kN", "needs a unit of damping"),
        (LinearSpecimen, "colour", 1, "is not a field"),
    ],
)
def test_a_field_out_of_bounds_is_named_with_value_and_bound(part: type, field: str, value: object, message: str) -> None:
    with pytest.raises(PlanError, match=message):
        validated(part, {field: value})


def test_a_quantity_may_carry_its_unit() -> None:
    assert validated(LinearSpecimen, {"damping": "500 kN*s/m"}).damping == 5e5
