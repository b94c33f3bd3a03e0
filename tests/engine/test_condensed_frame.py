"""A yielding frame without its massless degrees of freedom, against the same frame with all of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.parts.structures.frame_model import WEIGHTS
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running import condensed_frame, replay
from rths_engine.running import setup as set_up
from rths_engine.running.condensed_frame import condensed_equations
from rths_engine.running.run import Run
from rths_engine.running.yield_points import yield_and_push
from tests.engine.plans import LIBRARY, NO_LIMITS, completed, make, shaking
from tests.engine.test_frame import paper_frame

TIME = np.arange(400) * 0.01
STRONG = shaking(6.0 * np.sin(2 * np.pi * TIME / 1.2) * np.minimum(TIME, 1.0) + np.cos(2 * np.pi * TIME / 0.3), 0.01)
# no adaptation, which would amplify rounding
CALM = {"actuator": {"kind": "first_order_delay", "alpha": 2, "velocity_limit": 10.0}, "compensator": {"kind": "none"}}
EQUIVALENTS = {"equivalent_stiffness": 2e6, "equivalent_damping": 5e5}
SPECIMEN = {"kind": "linear", "stiffness": 2e6, "damping": 5e5}
STATIONS = [
    {"name": f"S{storey}", "storey": storey, "dampers": 2, "specimen": SPECIMEN, "limits": NO_LIMITS, **EQUIVALENTS, **CALM}
    for storey in (1, 2)
]
EFFECTS = [
    {"kind": "base_flexibility", "flexibility": 5e-9},
    {"kind": "damping_error", "share": 0.5},
    {"kind": "stiffness_error", "storey": 2, "share": 0.2},
    {"kind": "cubic_stiffness", "storey": 1, "stiffness": 1e8},
]


def planned(stations: bool = False, kind: str = "cr", frame: dict[str, Any] | None = None, **more: Any) -> Plan:
    tested = STATIONS if stations else []
    return make(paper_frame(**frame or {}), STRONG, 10 / 1024, substeps=10, kind=kind, stations=tested, **more)


def of_all(monkeypatch: pytest.MonkeyPatch, plan: Plan, **more: Any) -> Run:
    """The run of all degrees of freedom."""
    with monkeypatch.context() as patched:
        patched.setattr(set_up, "condensed_equations", lambda model: None)
        return completed(plan, **more)


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"stations": True},
        {"kind": "kr_alpha", "rho": 0.5},
        {"structure_physics": EFFECTS},
        {"frame": {"fixed_base": False, "p_delta": False}},
        {"test": "structure", "start": {"displacement": [0.05, 0.08], "velocity": [0.1, -0.2]}},
    ],
    ids=["alone", "stations", "kr_alpha", "effects", "pinned", "released"],
)
def test_a_yielding_frame_moves_as_with_all_equations(changed: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    plan = planned(**changed)
    few, every = completed(plan), of_all(monkeypatch, plan)
    assert len(few._state.x) < 8 and len(every._state.x) >= 122
    assert np.count_nonzero(every._state.plastic) > 20  # points that yielded
    assert np.count_nonzero(few._state.points.centre) == np.count_nonzero(every._state.plastic)
    scale = np.abs(every.signals).max(axis=0)
    assert (np.abs(few.signals - every.signals).max(axis=0) <= 1e-7 * scale).all()  # rounding: K spans seven decades
    assert few.history == pytest.approx(every.history, rel=0, abs=1e-8 * np.abs(every.history).max())


def test_a_start_with_every_degree_of_freedom_moving_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """The curvatures that do not follow the floors decay by the scheme, from the start on."""
    plan = planned(kind="kr_alpha")
    random = np.random.default_rng(5)
    count = len(Model(plan).built.mass)
    initial = (1e-3 * random.normal(size=count)).tolist(), (1e-3 * random.normal(size=count)).tolist()
    few, every = completed(plan, initial=initial), of_all(monkeypatch, plan, initial=initial)
    assert few.history == pytest.approx(every.history, rel=0, abs=1e-8 * np.abs(every.history).max())


def test_a_replay_moves_a_yielding_frame_as_its_run_did() -> None:
    run = completed(planned())
    moved = replay.structure(run.model, run._setup.inputs, np.zeros((len(run.history), 0)))
    assert (moved.floors == run.history[:, 0]).all()


def test_points_yield_in_python_as_in_machine_code() -> None:
    run = Run(planned(), LIBRARY)
    points = run._setup.points
    random = np.random.default_rng(6)
    both = [Run(planned(), LIBRARY)._state.points for _ in range(2)]
    forces = [np.zeros(len(run._state.x)) for _ in range(2)]
    for _ in range(5):
        x = 0.2 * random.normal(size=len(run._state.x))
        for step, states, force in zip((yield_and_push, yield_and_push.py_func), both, forces, strict=True):
            step(points, states, x, 0.3, 0.25, 0.01, force)
    assert np.count_nonzero(both[0].centre) > 0
    for machine, plain in zip((*both[0], forces[0]), (*both[1], forces[1]), strict=True):
        assert machine == pytest.approx(plain, rel=1e-12, abs=1e-15)


def test_the_points_are_those_of_the_members_that_can_yield() -> None:
    model = Model(planned())
    found = condensed_equations(model)
    assert found is not None
    able = np.isfinite(model.built.members.section[:, 3])
    assert found.points.limit.size == able.sum() * len(WEIGHTS) == 162  # all but the lean-on column
    assert found.kept.tolist() == sorted(model.built.floors)
    assert found.points.damping == pytest.approx(model.built.damping[5, 5] / model.built.stiffness[5, 5], rel=1e-12)


def test_a_frame_is_left_whole_where_condensation_would_not_be_exact(monkeypatch: pytest.MonkeyPatch) -> None:
    model = Model(planned())
    massless = np.flatnonzero(~model.built.mass.any(axis=0))
    uneven = model.built.damping.copy()
    uneven[massless[0], massless[0]] *= 1.0 + 1e-6
    built = model.built._replace(damping=uneven)
    other = Model(model.plan)
    vars(other)["built"] = built
    assert condensed_equations(other) is None
    monkeypatch.setattr(condensed_frame, "MOST_MEMBERS", 55)
    assert condensed_equations(model) is None
