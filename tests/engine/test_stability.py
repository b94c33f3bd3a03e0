"""Stability of the closed loop: closed forms, the published case, every part's linear behaviour."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from rths_engine.parts import actuators, compensators, specimens
from rths_engine.parts.actuators.interacting import InteractingActuator
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan, Station
from rths_engine.planning.reading import read_plan
from rths_engine.stability import ClosedLoop, delay_map, mapped, margin, published, stable, summary, warning
from rths_engine.stability import station as stations
from tests.engine.plans import NO_LIMITS, building, make, quiet, two_storeys

DT = 1 / 1024
KINDS = [
    (slot, kind)
    for slot, registry in (("compensator", compensators), ("actuator", actuators), ("specimen", specimens))
    for kind in registry.KINDS
]


def station(storey: int = 1, **more: Any) -> dict[str, Any]:
    given = {"name": f"S{storey}", "storey": storey, "compensator": {"kind": "none"}, "limits": NO_LIMITS}
    specimen = {"kind": "linear", "stiffness": 2e6, "damping": 0.0}
    return {**given, "actuator": {"kind": "first_order_delay", "alpha": 20}, "specimen": specimen, **more}


def one_storey(ratio: float, **more: Any) -> Plan:
    return make(building([2e5], [8e6], ratio), quiet(1.0), 10 / 1024, 10, **more)


@pytest.mark.parametrize("alpha", [(1.0, 1.0), (1.2, 1.5), (3.0, 5.0), (20.0, 1.0)])
def test_the_step_matrix_has_the_roots_of_the_characteristic_polynomial(alpha: tuple[float, float]) -> None:
    roots = np.abs(Polynomial(published.characteristic(alpha)).roots())
    found = np.abs(np.linalg.eigvals(ClosedLoop(published.section2(alpha)).matrix()))
    # double roots near zero and a cancelling sum: roots keep about half the digits
    assert np.sort(found)[-6:] == pytest.approx(np.sort(roots), abs=1e-7)


def test_an_undamped_structure_alone_neither_grows_nor_decays_and_has_the_frequency_of_cr() -> None:
    loop = ClosedLoop(one_storey(0.0))
    dt = 10 / 1024
    assert loop.radius() == pytest.approx(1.0, abs=1e-12)
    mode = loop.modes()[0]
    # CR: tan(theta / 2) = omega dt / 2
    assert mode.frequency == pytest.approx(np.arctan(np.sqrt(8e6 / 2e5) * dt / 2) / (np.pi * dt), rel=1e-9)
    assert stable(loop.radius())


@pytest.mark.parametrize("alpha", [4.0, 8.0])
def test_a_delayed_spring_is_negative_damping_of_its_stiffness_times_the_delay(alpha: float) -> None:
    actuator = {"kind": "first_order_delay", "alpha": alpha}
    loop = ClosedLoop(one_storey(0.0, stations=[station(actuator=actuator)]))
    mode = loop.modes()[0]
    omega, delay = np.sqrt(10e6 / 2e5), (alpha - 1) * DT
    expected = -2e6 * delay / (2 * 2e5 * omega)  # Horiuchi et al. (1999): c = -k tau, for omega tau << 1
    # the next order is (omega tau)^2 of it, 0.0023 at most
    assert mode.damping == pytest.approx(expected, rel=0.02)
    assert not stable(loop.radius())


def test_compensation_of_the_whole_delay_gives_back_the_loop_without_delay() -> None:
    actuator = {"kind": "first_order_delay", "alpha": 20}
    exact = one_storey(0.02, stations=[station(compensator={"kind": "inverse", "alpha_es": 20}, actuator=actuator)])
    none = one_storey(0.02, stations=[station(actuator={"kind": "first_order_delay", "alpha": 1})])
    assert ClosedLoop(exact).radius() == pytest.approx(ClosedLoop(none).radius(), abs=1e-10)


def test_figure_3_the_limit_is_almost_a_straight_line_and_lower_when_both_actuators_delay() -> None:
    alone = published.limit(1.0)
    assert alone is not None
    reach = published.largest_alpha1()
    alpha1 = np.linspace(1.0, reach, 9)
    alpha2 = np.array([published.limit(float(one)) for one in alpha1], dtype=float)
    straight = alone + (alpha1 - 1) / (reach - 1) * (1.0 - alone)
    # straight within a tenth of its range: for alpha1 > 2.77 it bends (7.4 % measured), the first mode being unstable first
    assert np.max(np.abs(alpha2 - straight)) < 0.1 * (alone - 1)
    assert np.all(np.diff(alpha2) < 0)


@pytest.mark.parametrize(("slot", "kind"), KINDS)
def test_the_linear_system_of_every_part_answers_as_its_own_steps_do(slot: str, kind: type[Any]) -> None:
    part: dict[str, Any] = {slot: {"kind": kind.model_fields["kind"].default}}
    if kind is InteractingActuator:  # unstable with a specimen much stiffer than the load that it carries
        part["specimen"] = {"kind": "linear_with_mass"}
    one = Station.model_validate(station(**part))
    chain = stations._Chain(one, DT, 0.0)
    linear = stations.linear(one, DT)
    rng = np.random.default_rng(4)
    commands = 1e-9 * np.cumsum(rng.normal(size=400)) / 20
    state, linear_state = chain.rest, np.zeros(len(linear.b))
    forces, predicted = [], []
    for command in commands:
        state = chain.step(state, float(command))
        linear_state = linear.a @ linear_state + linear.b * command
        forces.append(state[-1])
        predicted.append(linear.c @ linear_state)
    scale = np.max(np.abs(forces))
    # what is second order at a nanometre, and the 1e-10 to which a realisation keeps its response
    assert np.max(np.abs(np.array(forces) - predicted)) <= 1e-5 * scale


def test_a_realisation_by_its_response_is_the_system_found_by_perturbation() -> None:
    one = Station.model_validate(station(compensator={"kind": "inverse", "alpha_es": 12}, specimen={"kind": "mr_damper"}))
    chain = stations._Chain(one, DT, 0.0)
    answers = []
    for found in (stations._perturbed(chain), stations._realised(chain)):
        power, start, end, _ = found.over(7)
        answers.append([found.c @ start, found.c @ end, found.c @ power @ end, found.c @ power @ power @ end])
    # a realisation keeps its response to 1e-10, which unequal poles spread
    assert answers[1] == pytest.approx(answers[0], rel=1e-6)


def test_a_station_that_needs_too_many_states_is_told_not_predicted() -> None:
    """Robust control of a model so far off that it is unstable: its response never settles."""
    wild = {"kind": "robust", "gain": 0.2, "delay": 0.10025, "bandwidth": 25.0, "trust": 1000.0}
    said = warning(one_storey(0.02, stations=[station(compensator=wild)]))
    assert said == "Stability is not predicted: station 'S1' needs more than 504 states to be described about rest."


def test_more_delay_than_the_margin_is_unstable_and_less_is_not() -> None:
    plan = templates.template("two-storeys")
    loop = ClosedLoop(plan)
    for j in range(2):
        bears = margin(loop, j)
        assert bears is not None and bears > 1
        assert stable(loop.radius({j: loop.station(j, bears)}))
        assert not stable(loop.radius({j: loop.station(j, bears + 2e-4)}))


def test_an_unstable_plan_has_no_margin() -> None:
    found = summary(two_storeys((1, 1)))
    assert not found["stable"]
    assert [one["delay_margin_steps"] for one in found["stations"]] == [0.0, 0.0]
    assert found["least_damped"]["damping_ratio"] < 0
    assert "initial tangent" in found["notes"][0]


def test_the_map_holds_the_radius_of_each_pair_of_delays() -> None:
    plan = templates.template("two-storeys")
    loop = ClosedLoop(plan)
    found = delay_map(loop, points=5)
    for row, column in ((0, 0), (3, 1), (4, 4)):
        changed = plan.as_dict()
        changed["stations"][0]["actuator"]["alpha"] = found.first.values[column]
        changed["stations"][1]["actuator"]["alpha"] = found.second.values[row]
        # balancing differs with the matrix size
        assert found.radius[row, column] == pytest.approx(ClosedLoop(read_plan(changed)).radius(), abs=1e-9)
    assert (found.first.present, found.second.present) == (30.0, 45.0)
    assert found.radius.max() > 1 > found.radius.min()


def test_a_plan_of_one_station_has_no_map() -> None:
    assert mapped(templates.template("linear-damper"), points=5) is None


def frame(equivalent_stiffness: float) -> Plan:
    storeys = [
        {"mass": 663e3, "height": 4.57, "column": "W14x120", "beam": "W24x55", "brace_stiffness": 4e8},
        {"mass": 663e3, "height": 3.96, "column": "W14x120", "beam": "W18x40", "brace_stiffness": 4e8},
    ]
    data = templates.template("two-storeys").as_dict()
    data["structure"] = {"kind": "moment_frame", "bays": [9.15] * 4, "storeys": storeys}
    for one in data["stations"]:
        one["equivalent_stiffness"] = equivalent_stiffness
    return read_plan(data)


def test_a_frame_with_stiff_dampers_needs_their_equivalent_stiffness_in_the_integrator() -> None:
    assert ClosedLoop(frame(0.0)).radius() > 1.5
    assert ClosedLoop(frame(1e8)).radius() < 1.0


def test_what_nothing_reaches_drops_out_of_a_frame() -> None:
    structure = ClosedLoop(frame(0.0))._structure
    # two floors and two brace tops move; the other rotations and vertical displacements follow them
    assert len(structure.a) == 8
