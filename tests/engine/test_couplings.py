"""Stations that share a specimen: closed forms of the forces, frequency response, energy, and what a plan may not couple."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.recorded import components
from rths_engine.foundation.errors import PlanError, RecordingError
from rths_engine.parts.structures.matrices import MatricesStructure
from rths_engine.planning.coupling import KINDS, Attached, LoadingBeam, StrokeMatrices
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from rths_engine.planning.templates import template
from rths_engine.preflight.margins import margins
from rths_engine.results.result import Result
from rths_engine.running.run import simulate
from rths_engine.stability import SHARED, mapped, summary, warning
from tests.engine.plans import NO_LIMITS

RATE = 1024.0
EXACT = {"kind": "first_order_delay", "alpha": 1.0, "velocity_limit": 10.0}  # the actuator is at its command in each step
SERVO = {"kind": "servo_hydraulic", "velocity_limit": 10.0}
BEAM = LoadingBeam(
    spacing=3.0,
    offset=0.4,
    stiffness=3.0e6,
    rotational_stiffness=5.0e6,
    cross_stiffness=-1.2e6,
    damping=2.0e4,
    rotational_damping=3.0e4,
    mass=900.0,
    rotary_inertia=700.0,
)


def station(name: str, storey: int, **more: Any) -> dict[str, Any]:
    given = {"compensator": {"kind": "none"}, "actuator": EXACT, "specimen": {"kind": "none"}, "limits": NO_LIMITS}
    return {"name": name, "storey": storey, **given, **more}


def floor(coupling: Any, actuator: dict[str, Any] = EXACT, **more: Any) -> Plan:
    """A floor that translates and rotates, on the loading beam of a coupling, under a force on its translation."""
    rows = BEAM.transform().tolist()
    structure = {"mass": [[2e5, 0], [0, 3e5]], "stiffness": [[9e6, 0], [0, 2e7]], "damping_ratio": 0.05, "floors": [1]}
    force = {
        "floor": 1,
        "shape": {"kind": "chirp", "start_frequency": 0.2, "end_frequency": 3.0, "duration": 4.0},
        "amplitude": 5e4,
    }
    plan = {
        "structure": {"kind": "matrices", **structure, "drifts": rows},
        "forces": [force],
        "integrator": {"kind": "cr", "dt": 1 / RATE, "substeps": 1},
        "controller_rate": RATE,
        "stations": [station("left", 1, actuator=actuator), station("right", 2, actuator=actuator)],
        "couplings": [coupling.model_dump(mode="json")] if coupling else [],
        "duration": 4.0,
        **more,
    }
    return read_plan(plan)


def columns(found: Result, role: str) -> np.ndarray:
    keys = [channel.key for channel in found.channels]
    return np.column_stack([found.signals[:, keys.index(f"{role}.{number}")] for number in (1, 2)])


@pytest.fixture(scope="module")
def linear() -> Result:
    return simulate(floor(BEAM))


def test_the_beam_transmits_forces_by_virtual_work_from_translation_and_rotation() -> None:
    x1, x2 = BEAM.transform() @ [0.01, 0.002]  # 10 mm, 2 mrad
    assert (x1, x2) == (pytest.approx(0.01 + 0.002 * (0.4 - 1.5)), pytest.approx(0.01 + 0.002 * (0.4 + 1.5)))
    f1, f2 = BEAM.matrices().stiffness @ [x1, x2]
    assert f1 + f2 == pytest.approx(3.0e6 * 0.01 - 1.2e6 * 0.002)  # resultant at the axis
    assert f1 * (0.4 - 1.5) + f2 * (0.4 + 1.5) == pytest.approx(-1.2e6 * 0.01 + 5.0e6 * 0.002)  # moment about it


def test_the_recorded_forces_are_those_of_the_matrices_at_the_recorded_strokes(linear: Result) -> None:
    x, f, dt, shared = columns(linear, "x_meas"), columns(linear, "f_meas"), 1 / RATE, BEAM.matrices()
    v = np.diff(x, axis=0, prepend=0.0) / dt
    a = np.diff(v, axis=0, prepend=0.0) / dt
    wanted = x @ shared.stiffness + v @ shared.damping + a @ shared.mass
    assert np.abs(f).max() > 1e4
    np.testing.assert_allclose(f, wanted, atol=1e-9 * np.abs(a).max() * 1e3 + 1e-7 * np.abs(f).max())


def test_a_slow_test_is_quasi_static() -> None:
    """Under a force that grows over 50 periods, K_total y = (p, 0) of structure and specimen together."""
    slow = {"floor": 1, "shape": {"kind": "sine", "frequency": 0.01, "cycles": 0.25, "ramps": 0}, "amplitude": 5e4}
    found = simulate(floor(BEAM, forces=[slow], duration=25.0))
    own = np.array([[3.0e6, -1.2e6], [-1.2e6, 5.0e6]]) + np.diag([9e6, 2e7])
    still = np.linalg.solve(own, [5e4, 0.0])
    reached = np.linalg.solve(BEAM.transform(), columns(found, "x_meas")[-1])
    np.testing.assert_allclose(reached, still, rtol=2e-3, atol=2e-3 * abs(still[0]))


@pytest.mark.parametrize("frequency", [0.7, 1.2, 1.9])
def test_the_frequency_response_is_that_of_structure_and_specimen_in_state_space(frequency: float) -> None:
    """Steady vibration under a harmonic force, against (K - w^2 M + i w C)^-1 of both together.

    Near the resonance at 1.22 Hz a step's delay of the specimen's velocity and acceleration counts most.
    """
    cycles = round(24 * frequency)
    harmonic = {"floor": 1, "shape": {"kind": "sine", "frequency": frequency, "cycles": cycles, "ramps": 0}, "amplitude": 5e4}
    plan = floor(BEAM, forces=[harmonic], duration=cycles / frequency)
    assert isinstance(plan.structure, MatricesStructure)
    built = plan.structure.assemble()
    w, shared = 2 * np.pi * frequency, BEAM.matrices()
    rows = BEAM.transform()
    mass, damping, stiffness = (rows.T @ one @ rows for one in shared)
    dynamic = built.stiffness + stiffness - w**2 * (built.mass + mass) + 1j * w * (built.damping + damping)
    wanted = rows @ np.linalg.solve(dynamic, [5e4, 0.0])
    x, last = columns(simulate(plan), "x_meas"), round(4 / frequency * RATE)  # four whole periods at the end
    t = np.arange(1, len(x) + 1)[-last:] / RATE
    seen = 2 * (np.exp(-1j * w * t) * 1j) @ x[-last:] / last
    np.testing.assert_allclose(seen, wanted, rtol=0.02)


def test_an_undamped_specimen_gives_back_the_work_of_its_actuators() -> None:
    elastic = BEAM.model_copy(update={"damping": 0.0, "rotational_damping": 0.0, "mass": 0.0, "rotary_inertia": 0.0})
    found = simulate(floor(elastic))
    x, f = columns(found, "x_meas"), columns(found, "f_meas")
    work = np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(x, axis=0)) + 0.5 * f[0] @ x[0]
    stored = 0.5 * x[-1] @ elastic.matrices().stiffness @ x[-1]
    passed = np.sum(np.abs(0.5 * (f[1:] + f[:-1]) * np.diff(x, axis=0)))
    assert work == pytest.approx(stored, abs=1e-10 * passed)


def test_a_yielding_damper_on_the_beam_takes_energy_and_turns_it() -> None:
    """Off the axis it turns the floor; on the axis, with a symmetric beam, the floor only translates."""
    plain = LoadingBeam(spacing=3.0, stiffness=1e6, rotational_stiffness=1e6)
    rows = [[1.0, -1.5], [1.0, 1.5]]
    work, turned = {}, {}
    for position in (0.0, 1.0):
        law = {"kind": "bouc_wen", "stiffness": 2e7, "yield_force": 4e4}
        beam = plain.model_copy(update={"specimens": (Attached.model_validate({"position": position, "specimen": law}),)})
        plan = floor(beam)
        plan = read_plan({**plan.as_dict(), "structure": {**plan.as_dict()["structure"], "drifts": rows}})
        found = simulate(plan)
        x, f = columns(found, "x_meas"), columns(found, "f_meas")
        work[position] = float(np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(x, axis=0)))
        turned[position] = float(np.abs(x[:, 1] - x[:, 0]).max() / 3.0)
    assert min(work.values()) > 500.0  # J
    assert turned[0.0] < 1e-9 and turned[1.0] > 1e-3


def test_a_diagonal_coupling_is_two_stations_of_their_own() -> None:
    apart = StrokeMatrices(stiffness=((4e6, 0.0), (0.0, 2e6)), damping=((5e4, 0.0), (0.0, 3e4)))
    noisy = {"noise": {"displacement": 1e-5, "force": 100.0}}
    servo = [{**one, **noisy} for one in (station("left", 1, actuator=SERVO), station("right", 2, actuator=SERVO))]
    own = [{"kind": "linear", "stiffness": k, "damping": c} for k, c in ((4e6, 5e4), (2e6, 3e4))]
    equivalent = [{"equivalent_stiffness": one["stiffness"], "equivalent_damping": one["damping"]} for one in own]
    alone = [{**one, "specimen": law, **eq} for one, law, eq in zip(servo, own, equivalent, strict=True)]
    shared, single = simulate(floor(apart, stations=servo)), simulate(floor(None, stations=alone))
    assert shared.status == single.status == "completed"
    off = np.abs(shared.signals - single.signals).max(axis=0)
    assert (off <= 1e-9 * np.abs(single.signals).max(axis=0)).all()


def test_an_actuator_feels_the_other_through_the_specimen() -> None:
    """Only the left storey moves; the right command is zero, and the beam pushes the right piston off its place."""
    still = [[1.0, 0.0], [0.0, 0.0]]
    plan = floor(StrokeMatrices(stiffness=((4e6, 3e6), (3e6, 4e6))), SERVO).as_dict()
    pushed = simulate(read_plan({**plan, "structure": {**plan["structure"], "drifts": still}}))
    assert np.abs(columns(pushed, "x_cmd")[:, 1]).max() == 0.0
    assert np.abs(columns(pushed, "x_meas")[:, 1]).max() > 1e-6
    plan["couplings"][0]["stiffness"] = [[4e6, 0.0], [0.0, 4e6]]
    free = simulate(read_plan({**plan, "structure": {**plan["structure"], "drifts": still}}))
    assert np.abs(columns(free, "x_meas")[:, 1]).max() == 0.0


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_kind_of_coupling_is_passive_symmetric_and_says_its_equation(kind: type[Any]) -> None:
    made = kind(stiffness=((2.0, 1.0), (1.0, 2.0))) if kind is StrokeMatrices else kind()
    for matrix in made.matrices():
        assert matrix.shape == (len(made.stations),) * 2 and np.allclose(matrix, matrix.T)
        assert np.linalg.eigvalsh(matrix)[0] >= -1e-9 * np.abs(matrix).max()
    assert made.laws() == [] and "=" in (kind.__doc__ or "").splitlines()[0] and kind.title
    for name, field in kind.model_json_schema()["properties"].items():
        assert field["title"], name


def test_a_plan_with_a_coupling_is_written_read_and_has_a_digest_of_its_own() -> None:
    plan = template("two-actuators")
    assert plan_from_yaml(plan_to_yaml(plan)) == plan
    stiffer = plan.couplings[0].model_copy(update={"stiffness": 3e6})
    assert plan.model_copy(update={"couplings": (stiffer,)}).digest != plan.digest
    assert template("linear-damper").digest == "dcdcd1f1bebf584d44b79c296d66d1de287ac4cb07a7b29faea40f94fa84437b"  # as before


def test_stability_and_diagnosis_say_that_they_leave_couplings_out() -> None:
    plan = template("two-actuators")
    assert summary(plan)["notes"] == [SHARED] and summary(plan)["radius"] is None
    assert warning(plan) == SHARED and mapped(plan, 4) is None
    found = margins(Model.of(plan), 1e9)
    assert found is not None and found["notes"] == [SHARED]
    with pytest.raises(RecordingError, match="share a specimen"):
        components(plan, None, "recording")  # type: ignore[arg-type]


def broken(**changes: Any) -> str:
    plan = floor(BEAM).as_dict()
    for path, value in changes.items():
        place: Any = plan
        *names, last = path.split("__")
        for name in names:
            place = place[int(name) if name.isdigit() else name]
        place[int(last) if last.isdigit() else last] = value
    with pytest.raises(PlanError) as refused:
        read_plan(plan)
    return str(refused.value)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"couplings__0__stations": [1, 3]}, "couplings.0.stations = 3: is not the number of a station"),
        ({"couplings__0__stations": [1, 1]}, "station 1 is already on the specimen 'Beam'"),
        ({"couplings__0__stations": [1]}, "couplings.0.stations: needs at least 2 item(s)"),
        ({"stations__0__specimen": {"kind": "linear"}}, "stations.0.specimen = linear: shares a specimen"),
        ({"stations__1__specimen_physics": [{"kind": "asymmetry"}]}, "stations.1.specimen_physics"),
        ({"stations__1__dampers": 2}, "represents itself only"),
        ({"stations__0__connection": {"kind": "generic_client"}}, "stations.0.connection = generic_client: is an external rig"),
        ({"couplings__0__cross_stiffness": 4e6}, "would give out energy"),
        ({"couplings__0__specimens": [{"specimen": {"kind": "mr_damper_current"}}]}, "follows a current"),
        ({"couplings__0__mass": 9000.0, "stations__0__actuator": SERVO, "stations__1__actuator": SERVO}, "couplings.0.mass"),
        ({"couplings__0__spacing": 1e-300}, "couplings.0.spacing = 1e-300: needs a value >= 0.001"),
        ({"couplings__0__mass": 1e9, "stations__0__actuator": SERVO | {"mass": 1e-300}}, "couplings.0.mass"),
        ({"couplings__0": {"kind": "matrices", "stiffness": [[1, 2], [2, 1]]}}, "has the negative eigenvalue -1"),
        ({"couplings__0": {"kind": "matrices", "stiffness": [[1, 2], [1, 1]]}}, "is not symmetric"),
        ({"couplings__0": {"kind": "matrices", "stiffness": [[1, 0], [0]]}}, "needs 2 rows of 2 numbers"),
        (
            {"couplings__0": {"kind": "matrices", "stiffness": [[1, 0], [0, 1]], "specimens": [{"weights": [1]}]}},
            "couplings.0.specimens.0.weights = 1: needs 2 weights",
        ),
    ],
)
def test_a_coupling_that_cannot_be_is_refused_with_its_place(changes: dict[str, Any], said: str) -> None:
    assert said in broken(**changes)
