"""The engine's models of a case's component over noise-free inputs, for the oracle."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.physics.effect import GROUND, Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.parts.physics.structure.storey import drift
from rths_engine.planning.model import Model
from rths_engine.planning.plan import ROOM, Plan
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.running import replay

FINE = 2.5e-4  # s: substeps of replays of a specimen
STEP = 1e-3  # s: of a structure


@dataclass(frozen=True)
class Case:
    """An opened case: its plan, its truth, and the shown and the noise-free channels of both recordings."""

    plan: Plan
    truth: dict[str, Any]
    shown: tuple[dict[str, Array], dict[str, Array]]
    quiet: tuple[dict[str, Array], dict[str, Array]]
    dt: float

    @classmethod
    def opened(cls, shown: Path, sealed: Path) -> Case:
        truth = json.loads((sealed / "truth.json").read_text(encoding="utf-8"))
        plan = plan_from_yaml((shown / "plan.yaml").read_text(encoding="utf-8"))
        seen, hidden = ([_channels(folder / name) for name in ("fit.h5", "heldout.h5")] for folder in (shown, sealed))
        with h5py.File(shown / "fit.h5") as file:
            dt = float(file.attrs["dt"])
        return cls(plan, truth, (seen[0], seen[1]), (hidden[0], hidden[1]), dt)


class SpecimenModel:
    """Displacement -> force, replayed in substeps of a cubic spline through the displacement."""

    rivals = physics.SPECIMEN
    tolerances: tuple[float, ...] = ()

    def __init__(self, case: Case) -> None:
        self.case, self.base = case, (case.plan.stations[0].specimen,)
        self.finer = max(1, int(np.ceil(case.dt / FINE)))
        self.inputs = [self._fine(one["x_meas.1"]) for one in case.quiet]
        self.keys = ["f_meas.1"]

    def _fine(self, x: Array) -> Array:
        from scipy.interpolate import CubicSpline

        place = np.arange(len(x))
        return np.asarray(CubicSpline(place, x)(np.arange((len(x) - 1) * self.finer + 1) / self.finer))

    def out(self, parts: tuple[Any, ...], which: int) -> list[Array]:
        x, n = self.inputs[which], self.finer
        current = self.case.quiet[which].get("current.1", np.ones(1 + len(x) // n))
        warmth = self.case.quiet[which].get("temperature.1")
        warmth = None if warmth is None else np.repeat(warmth, n)[: len(x)]
        force = replay.specimen(parts[0], parts[1:], x, np.repeat(current, n)[: len(x)], self.case.dt / n, temperature=warmth)
        return [force[::n]]

    def seen(self, storey: int = 1) -> Seen:
        x, f = self.inputs[0][:: self.finer], self.case.quiet[0]["f_meas.1"]
        v = np.gradient(x, self.case.dt)
        most_x, most_v, most_f = (float(np.max(np.abs(one))) for one in (x, v, f))
        energy, quiet = float(np.sum(np.abs(f * v)) * self.case.dt), self.case.quiet[0]
        current, warmth = float(np.max(quiet.get("current.1", 1.0))), float(np.mean(quiet.get("temperature.1", ROOM)))
        return Seen(most_x, most_v, most_f, len(x) * self.case.dt, energy, self.case.dt, current=current, temperature=warmth)


class ActuatorModel:
    """Command -> displacement, against the force of the specimen."""

    rivals = physics.ACTUATOR
    tolerances = (0.05, 0.05, 0.05)

    def __init__(self, case: Case) -> None:
        self.case, self.base, self.keys = case, (case.plan.stations[0].actuator,), ["x_meas.1"]

    def out(self, parts: tuple[Any, ...], which: int) -> list[Array]:
        command = self.case.shown[which]["x_comp.1"]
        return [replay.actuator(parts[0], parts[1:], command, self.case.quiet[which]["f_meas.1"], self.case.dt)]

    def seen(self, storey: int = 1) -> Seen:
        x, f = self.case.shown[0]["x_comp.1"], self.case.quiet[0]["f_meas.1"]
        v = np.gradient(x, self.case.dt)
        most_x, most_v, most_f = (float(np.max(np.abs(one))) for one in (x, v, f))
        return Seen(most_x, most_v, most_f, len(x) * self.case.dt, float(np.sum(np.abs(f * v)) * self.case.dt), self.case.dt)


class StructureModel:
    """Ground acceleration -> floors. The base parts are shares of each storey's stiffness and of the damping."""

    rivals = (*physics.STRUCTURE, *physics.INPUT)

    def __init__(self, case: Case) -> None:
        self.case, self.keys = case, list(case.truth["about"]["channels"])
        built = Model(case.plan).built
        self.floors = built.floors
        storeys = range(1, len(built.floors) + 1)
        self.rows = [drift(built, storey) for storey in storeys]
        self.base: tuple[Part, ...] = (*(StiffnessError(storey=storey) for storey in storeys), DampingError())
        self.tolerances = (*(0.03 for _ in storeys), 0.2)
        self.built = built

    def out(self, parts: tuple[Any, ...], which: int) -> list[Array]:
        x, ground = self._moved(parts, which)
        found = []
        for key in self.keys:
            row = x[:, int(key[-1]) - 1]
            if key.startswith("a"):
                row = np.gradient(np.gradient(row, self.case.dt), self.case.dt) + ground
            found.append(row)
        return found

    def _moved(self, parts: tuple[Any, ...], which: int) -> tuple[Array, Array]:
        dt = self.case.dt
        ground = self.case.quiet[which]["ag"]
        felt = ground
        for one in parts:
            if isinstance(one, Effect) and one.hook == GROUND:
                felt = one.shaken(felt, dt)
        fine = int(np.ceil(dt / STEP))
        count = np.arange(len(felt))
        inputs = np.interp(np.arange((len(felt) - 1) * fine + 1) / fine, count, felt)[:, None]
        effects = tuple(one for one in parts if isinstance(one, physics.STRUCTURE))
        plan = self.case.plan.model_copy(
            update={"structure_physics": effects, "integrator": CrIntegrator(dt=dt / fine, substeps=1)}
        )
        return replay.structure(plan, inputs, np.zeros((len(inputs), 0))).floors[::fine], felt

    def seen(self, storey: int = 1) -> Seen:
        x, _ = self._moved(self.base, 0)
        moved = x @ self.rows[storey - 1][list(self.floors)]
        v = np.gradient(moved, self.case.dt)
        k = 1 / float(self.rows[storey - 1] @ np.linalg.solve(self.built.stiffness, self.rows[storey - 1]))
        top = float(np.max(np.abs(moved)))
        return Seen(top, float(np.max(np.abs(v))), k * top, len(moved) * self.case.dt, k * top**2, self.case.dt, storey)


def model(case: Case) -> SpecimenModel | ActuatorModel | StructureModel | None:
    """The component of the truth; None where the oracle has no model of it (a chain, a release)."""
    effects, kind = case.truth["effects"], case.truth["kind"]
    component = (effects[0]["component"] if effects else case.truth["about"].get("component") or "specimen:1").partition(":")[0]
    if kind == "structure":
        return None if case.truth["about"]["free"] else StructureModel(case)
    if "x_meas.1" not in case.shown[0] or component == "sensor":
        return None
    return ActuatorModel(case) if component == "actuator" else SpecimenModel(case)


def _channels(path: Path) -> dict[str, Array]:
    with h5py.File(path) as file:
        return {key: file[key][:] for key in file}
