"""The moment-resisting frame of the paper, and what a frame must do by hand calculation."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.parts.structures.assembled import Members
from rths_engine.parts.structures.frame_model import FrameModel, Member
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.parts.structures.sections import SECTIONS
from rths_engine.planning.model import Model
from rths_engine.running.restoring import rows, subtract_forces, subtract_product
from tests.engine.plans import completed, make, quiet, shaking


def paper_frame(**more: Any) -> dict[str, Any]:
    storeys = [
        {"height": 4.57, "mass": 662.9e3, "column": "W14x120", "beam": "W24x55", "brace_stiffness": 4e8},
        {"height": 3.96, "mass": 662.9e3, "column": "W14x120", "beam": "W18x40", "brace_stiffness": 4e8},
    ]
    return {"kind": "moment_frame", "bays": [9.15] * 4, "storeys": storeys, **more}


def restoring(members: Members, elastic: np.ndarray, path: np.ndarray) -> np.ndarray:
    """r(x) along a path of displacements (steps, DOF), by the compiled members and springs."""
    plastic = np.zeros((len(members.dofs), 3))
    forces = np.zeros_like(path)
    for x, force in zip(path, forces, strict=True):
        subtract_product(rows(elastic), x, force)
        subtract_forces(members, x, plastic, force)
    return -forces


def test_the_papers_frame_has_its_equations_period_and_storey_stiffness() -> None:
    frame = validated(MomentFrame, paper_frame())
    model, built = frame.model(), frame.assemble()
    assert (model.size, len(model.members), len(model.bars)) == (122, 56, 4)
    plan = make(paper_frame(), quiet(1.0), 10 / 1024)
    assert Model(plan).periods[:2] == pytest.approx([1.48, 0.421], rel=0.005)  # the paper's T1; T2 as OpenSees finds it
    assert len(Model(plan).periods) == 2  # massless degrees of freedom have no period
    # storey stiffness = storey shear over drift under loads in the first mode's pattern
    flexibility = np.linalg.inv(built.stiffness)[np.ix_(built.floors, built.floors)]
    values, shapes = np.linalg.eig(flexibility)
    shape = np.abs(shapes[:, np.argmax(values)])
    floors = flexibility @ shape
    stiffness = [shape.sum() / floors[0], shape[1] / (floors[1] - floors[0])]
    assert stiffness == pytest.approx([36_007e3, 23_894e3], rel=0.015)


def test_small_displacements_give_the_initial_stiffness() -> None:
    built = validated(MomentFrame, paper_frame()).assemble()
    x = 1e-6 * np.random.default_rng(2).normal(size=len(built.mass))
    force = restoring(built.members, built.elastic, x[None])[0]
    assert force == pytest.approx(built.stiffness @ x, rel=1e-9, abs=1e-6 * np.abs(force).max())


def portal(**more: Any) -> MomentFrame:
    storey = {"height": 8.0, "mass": 1e5, "column": "W18x40", "beam": "W36x135"}
    return validated(MomentFrame, {"bays": [8.0], "storeys": [storey], "p_delta": False, **more})


def test_a_portal_has_the_sway_stiffness_of_the_closed_form() -> None:
    built = portal().assemble()
    sway = 1 / np.linalg.inv(built.stiffness)[built.floors[0], built.floors[0]]
    column, beam = SECTIONS["W18x40"].inertia, SECTIONS["W36x135"].inertia
    ratio = beam / column  # of I / length, the lengths being equal
    exact = 24 * 200e9 * column / 8.0**3 * (1 + 6 * ratio) / (4 + 6 * ratio)
    assert sway == pytest.approx(exact, rel=0.01)  # less the columns' elongation, which the closed form leaves out


def test_p_delta_softens_a_storey_by_its_weight_over_its_height() -> None:
    floor = portal().assemble().floors[0]
    soft, stiff = (portal(p_delta=on).assemble().stiffness[floor, floor] for on in (True, False))
    lean_on = 12 * 200e9 * 1e-5 / 8.0**3
    assert stiff + lean_on - soft == pytest.approx(1e5 * 9.80665 / 8.0, rel=1e-6)


def test_a_member_in_uniform_bending_follows_its_bilinear_moment_curvature_law() -> None:
    bending, yield_moment, length, hardening = 5e7, 4e5, 2.0, 0.03
    model = FrameModel()
    start, end = (model.node(x, 0.0, fixed=(True, True, False)) for x in (0.0, length))
    model.members.append(Member(start, end, 1e9, bending, yield_moment, hardening / (1 - hardening) * bending))
    limit = yield_moment / bending
    curvature = limit * np.concatenate([np.linspace(0, 5, 101), np.linspace(5, -3, 161)])
    path = np.outer(curvature, [-length / 2, length / 2])
    moment = restoring(model.tables(), model.rest(), path)[:, 1]
    loading = np.where(curvature[:101] <= limit, curvature[:101], limit + hardening * (curvature[:101] - limit))
    assert moment[:101] == pytest.approx(bending * loading, rel=1e-9)
    peak = bending * (limit + hardening * 4 * limit)
    elastic = curvature[101:] >= 3 * limit  # unloads over twice the yield curvature (kinematic hardening)
    assert moment[101:][elastic] == pytest.approx(peak - bending * (5 * limit - curvature[101:][elastic]), rel=1e-9)
    backward = bending * (-limit + hardening * (curvature[-1] + limit))
    assert moment[-1] == pytest.approx(backward, rel=1e-9)


def test_a_yielding_frame_dissipates_and_drifts_less_than_its_stiffness_says() -> None:
    time = np.arange(800) * 0.01
    motion = shaking(5.0 * np.sin(2 * np.pi * time / 1.48) * np.minimum(time / 2, 1), 0.01)
    peaks = {}
    for inelastic in (False, True):
        run = completed(make(paper_frame(inelastic=inelastic), motion, 10 / 1024))
        peaks[inelastic] = np.max(np.abs(run.history[:, 0]), axis=0)
    assert (peaks[True] < 0.8 * peaks[False]).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bays": []}, "at least 1 item"),
        ({"hinge_fraction": 0.5}, "needs a value <= 0.49"),
        (
            {"storeys": [{"height": 4, "mass": -1, "column": "W14x120", "beam": "W24x55"}]},
            "storeys.0.mass = -1: needs a value > 0",
        ),
        (
            {"storeys": [{"height": 4, "mass": 1e5, "column": "W99x1", "beam": "W24x55"}]},
            "storey 1 has the unknown section 'W99x1'",
        ),
        ({"storeys": [{"height": 4, "column": "W14x120", "beam": "W24x55"}]}, "storeys.0.mass: is required"),
        ({"bays": [9.0] * 20, "storeys": paper_frame()["storeys"] * 20}, "degrees of freedom; the maximum is 3000"),
    ],
)
def test_a_frame_that_cannot_stand_is_named(change: dict[str, Any], message: str) -> None:
    with pytest.raises(PlanError, match=message):
        validated(MomentFrame, {**paper_frame(), **change})


def test_a_frame_that_p_delta_overturns_is_a_mechanism() -> None:
    storey = {"height": 4.0, "mass": 1e9, "column": "W18x40", "beam": "W18x40"}
    with pytest.raises(PlanError, match="mechanism"):
        validated(MomentFrame, {"bays": [9.0], "storeys": [storey]}).assemble()
