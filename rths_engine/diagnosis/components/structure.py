"""A structure: its inputs are ground acceleration, forces and a start, and its outputs are the motions of the floors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import eigh

from rths_engine.diagnosis.components.component import Component, Data, Feature, Loose, Signal, State, guessed
from rths_engine.diagnosis.components.features import Sizes, of_motion
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity
from rths_engine.parts import physics
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.physics.effect import GROUND, MATRICES, Effect
from rths_engine.parts.physics.search import Seen, trend
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.mass_error import MassError
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.parts.physics.structure.storey import OfStorey, drift, stiffness
from rths_engine.parts.structures.assembled import Assembled
from rths_engine.planning.excitation import FloorForce, Start
from rths_engine.planning.known import structure_tolerance
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running import replay

# chosen; see docs/decisions/0023
FEW_MODES = 3  # modes whose damping may have different errors
FINE = 2e-3  # s: with this step, the error of integration is far below the noise
FEW = 20  # largest number of degrees of freedom for which this step is cheap
MOST_STOREYS = 6  # storeys for which unknown laws are searched


class Release(Loose):
    """Correction of a floor's start: its displacement and velocity relative to the estimate from the first samples."""

    floor: int = quantity("Floor", ge=1, default=1)
    displacement: float = quantity("Displacement at the start", "m", "mm", default=0.0)
    velocity: float = quantity("Velocity at the start", "m/s", "mm/s", default=0.0)
    scale: ClassVar[float] = 1e-3


class ModeDamping(Loose):
    """Error of the damping of one mode. A damping matrix that is computed from slightly wrong M and K has such errors."""

    mode: int = quantity("Mode", ge=2, default=2)
    share: float = quantity("Damping error e of the mode", "1", "%", ge=-0.5, le=0.5, default=0.0)
    scale: ClassVar[float] = 1.0


class AddedDamping(NamedTuple):
    """An addition c to the damping matrix: C + c."""

    damping: Array
    hook: int = MATRICES

    def assembled(self, built: Assembled) -> Assembled:
        return built._replace(damping=built.damping + self.damping)


# chosen; see docs/decisions/0023
TOLERANCES: dict[type[Part], float] = {StiffnessError: 0.03, DampingError: 0.2, ModeDamping: 0.03}
QUANTITIES = {MassError: "mass", StiffnessError: "stiffness", DampingError: "damping", ModeDamping: "mode"}


class Zero(Loose):
    """The reading of a floor's displacement at rest."""

    floor: int = quantity("Floor", ge=1, default=1)
    displacement: float = quantity("Displacement read at rest", "m", "mm", default=0.0)
    scale: ClassVar[float] = 1e-3


Kind = Literal["x", "v", "a"]


@dataclass(frozen=True)
class StructureData(Data):
    """Signals of a structure: ground acceleration (m/s^2), forces (N) by floor, and the measured motions of the floors.

    Displacements and velocities are relative to the ground, accelerations are absolute. `released` are the displacements and
    velocities of all floors at the start, or None where the structure was at rest. `substeps` is the number of substeps in an
    integration step of the recorded run.
    """

    ground: Array
    forces: dict[int, Array]
    floors: tuple[tuple[Kind, int, Array], ...]
    released: tuple[tuple[float, ...], tuple[float, ...]] | None
    substeps: int

    @property
    def raw(self) -> Array:
        return np.array([values for _, _, values in self.floors])

    @cached_property
    def inputs(self) -> Array:
        """Ground acceleration and forces (samples, 1 + forces)."""
        return np.column_stack([self.ground, *self.forces.values()])


@dataclass(frozen=True)
class Structure(Component):
    """The structure of `plan`: ground motion, forces and start -> floor motions. The effects of the plan are kept."""

    plan: Plan
    output: ClassVar[str] = "motion of the floors"

    def spread(self, part: Part, field: str = "") -> float | None:
        quantity = QUANTITIES.get(type(part))
        stated = structure_tolerance(self.plan.known, quantity) if quantity else None
        return TOLERANCES.get(type(part)) if stated is None else stated

    def predicted(self, parts: Sequence[Any], data: StructureData) -> Array:
        return self._shown(self.motion(parts, data), data) + self._read(parts, data)

    def _read(self, parts: Sequence[Any], data: StructureData) -> Array:
        """The reading (channels, 1) of each channel at rest."""
        zeros = {part.floor: part.displacement for part in parts if isinstance(part, Zero)}
        read = [zeros.get(floor, 0.0) if kind == "x" else 0.0 for kind, floor, _ in data.floors]
        return np.array(read)[:, None]

    def motion(self, parts: Sequence[Any], data: StructureData, extra: Array | None = None) -> Array:
        """Displacements (m) of the floors (samples, floors), in `finer` steps.

        `extra` (samples, floors) are forces (N) on every floor.
        """
        ground = data.ground
        for effect in parts:
            if isinstance(effect, Effect) and effect.hook == GROUND:
                ground = effect.shaken(ground, data.dt)
        inputs = np.column_stack([ground, data.inputs[:, 1:]])
        on = list(data.forces)
        if extra is not None:
            inputs, on = np.column_stack([inputs, extra]), [*on, *range(1, extra.shape[1] + 1)]
        effects = tuple(part for part in parts if isinstance(part, physics.STRUCTURE))
        update: dict[str, Any] = {
            "structure_physics": (*self.plan.structure_physics, *self._modal(parts), *effects),
            "forces": tuple(FloorForce(floor=floor) for floor in on),
            "start": _start(parts, data),
        }
        if data.stepped:
            n = data.substeps
            at = self._floors(self.model.changed(**update), _at_steps(inputs, n))
            share = np.arange(1, n + 1)[:, None] / n
            ramps = at[:-1, None] + share * (at[1:] - at[:-1])[:, None]
            moved: Array = ramps.reshape(-1, at.shape[1])
            return moved
        fine = self.finer(data)
        model = self.model.changed(**update, integrator=CrIntegrator(dt=data.dt / fine, substeps=1))
        if fine > 1:
            at = np.arange(0, len(inputs) - 1 + 1e-9, 1 / fine)
            inputs = np.asarray(CubicSpline(np.arange(len(inputs)), inputs)(at))
        return self._floors(model, inputs)

    def finer(self, data: StructureData) -> int:
        """Number of replay steps in a sample."""
        return 1 if data.stepped or len(self.built.mass) > FEW else int(np.ceil(data.dt / FINE - 1e-9))

    def _floors(self, model: Model, inputs: Array) -> Array:
        return replay.structure(model, inputs, np.zeros((len(inputs), len(model.plan.stations)))).floors

    @cached_property
    def model(self) -> Model:
        return Model(self.plan)

    @property
    def built(self) -> Assembled:
        return self.model.built

    def _modal(self, parts: Sequence[Any]) -> list[AddedDamping]:
        own = [part.share * self.dampings[part.mode - 1] for part in parts if isinstance(part, ModeDamping)]
        return [AddedDamping(sum(own[1:], own[0]))] if own else []

    @cached_property
    def dampings(self) -> list[Array]:
        """The share of each of the lowest modes in C: (phi^T C phi) M phi phi^T M with unit modal mass."""
        flexible, modes = eigh(self.built.mass, self.built.stiffness)  # 1 / omega^2, rising
        shapes = (modes / np.sqrt(np.maximum(flexible, 1e-300)))[:, : -FEW_MODES - 1 : -1].T
        pushes = [self.built.mass @ shape for shape in shapes]
        return [shape @ self.built.damping @ shape * np.outer(push, push) for shape, push in zip(shapes, pushes, strict=True)]

    def _shown(self, x: Array, data: StructureData) -> Array:
        n = self.finer(data)
        rows = []
        for kind, floor, _ in data.floors:
            row = x[:, floor - 1]
            for _ in range("xva".index(kind)):
                row = np.gradient(row, data.dt / n)
            rows.append(row[::n] + data.ground if kind == "a" else row[::n])
        return data.reduced(np.array(rows))

    def drifts(self, data: StructureData) -> Array:
        """Storey drifts (storeys, samples) in m, simulated with the planned model."""
        return _drifts(self.motion(self.base, data)[:: self.finer(data)])

    def seen(self, data: StructureData) -> list[Seen]:
        found = []
        for storey, moved in enumerate(self.drifts(data), start=1):
            v = np.gradient(moved, data.dt)
            k = stiffness(self.built, drift(self.built, storey))
            x_top, v_top = float(np.max(np.abs(moved))), float(np.max(np.abs(v)))
            found.append(Seen(x_top, v_top, k * x_top, len(moved) * data.dt, k * x_top * x_top, data.dt, storey, trend(moved)))
        return found

    def hypotheses(self, data: StructureData) -> Iterator[Effect]:
        for seen in self.seen(data):
            yield from guessed((kind for kind in physics.STRUCTURE if issubclass(kind, OfStorey) or seen.storey == 1), seen)
            if seen.storey == 1 and data.ground.any():
                yield from guessed(physics.INPUT, seen)

    def features(self, parts: Sequence[Any], data: StructureData, like: Any = None) -> list[Feature]:
        plain = self.motion(parts, data)
        before = self._shown(plain, data)
        x = _drifts(plain[:: self.finer(data)])
        other = data if like is None or like is data else like
        tops = x if other is data else _drifts(self.motion(parts, other)[:: self.finer(other)])
        found = []
        for storey, (moved, top) in enumerate(zip(x[:MOST_STOREYS], tops, strict=False), start=1):
            v = np.gradient(moved, data.dt)
            sizes = Sizes.of(top, np.gradient(top, other.dt), other.dt, top)
            size = 0.01 * self._stiffness(storey) * sizes.x
            for formula, words, values in of_motion(moved, v, data.dt, moved, sizes):
                change = self._shown(self.motion(parts, data, self._between(storey, size * values)), data) - before
                found.append(Feature(formula, f"storey {storey}: {words}", change, sizes, size, f"storey {storey}"))
        return found

    def _between(self, storey: int, force: Array) -> Array:
        """Forces (samples, floors) of a resistance `force` (N) in a storey: against its upper floor, with its lower floor."""
        extra = np.zeros((len(force), len(self.built.floors)))
        extra[:, storey - 1] -= force
        if storey > 1:
            extra[:, storey - 2] += force
        return extra

    def _stiffness(self, storey: int) -> float:
        return float(stiffness(self.built, drift(self.built, storey)))

    def states(self, data: StructureData) -> list[State]:
        """The simulated drift of each storey at the sampling rate of the recording."""
        found = []
        for storey, moved in enumerate(self.drifts(data)[:MOST_STOREYS], start=1):
            x = Signal("simulated drift", "m", "mm", moved)
            v = Signal("simulated drift velocity", "m/s", "mm/s", np.gradient(moved, data.dt))
            found.append(State(f"storey {storey}", x, v))
        return found

    def loaded(self, parts: Sequence[Any], data: StructureData, added: Sequence[Array]) -> Array:
        extra = sum(self._between(storey, force) for storey, force in enumerate(added, start=1))
        return self._shown(self.motion(parts, data, np.asarray(extra)), data) + self._read(parts, data)

    def signals(self, data: StructureData) -> tuple[Signal, Signal]:
        moved = self.drifts(data)[0]
        x, v = data.reduced(np.array([moved, np.gradient(moved, data.dt)]))
        return Signal("simulated drift of storey 1", "m", "mm", x), Signal("simulated drift velocity", "m/s", "mm/s", v)

    def present(self, parts: Sequence[Part]) -> set[tuple[type[Part], int]]:
        """Keys of the effects behind the base. Effects of the base stay hypotheses: they may exceed their tolerance."""
        return super().present(parts[len(self.base) :])

    def place(self, effect: Effect) -> str:
        if effect.hook == GROUND:
            return "input"
        return f"structure:{effect.storey}" if isinstance(effect, OfStorey) else "structure"


def based(plan: Plan, released: bool, read: Sequence[int]) -> tuple[Part, ...]:
    """The base parts of a structure, whose parameters are fitted within tolerances.

    They are the stiffness error of each storey and the damping errors, also of higher modes. Where the plan states how well the
    mass is known, the mass error of each floor follows. A `released` structure also has the corrections of the start and the
    zeros of the floor displacements that were `read`.
    """
    floors = range(1, len(plan.structure.assemble().floors) + 1)
    stiff = [StiffnessError(storey=storey) for storey in floors]
    damped = (DampingError(), *(ModeDamping(mode=mode) for mode in range(2, min(FEW_MODES, len(stiff)) + 1)))
    heavy = [MassError(storey=storey) for storey in floors] if "structure.mass" in plan.known else []
    if not released:
        return (*stiff, *damped, *heavy)
    return (*stiff, *damped, *heavy, *(Release(floor=floor) for floor in floors), *(Zero(floor=floor) for floor in read))


def _drifts(x: Array) -> Array:
    """Storey drifts (storeys, samples) from floor displacements (samples, floors)."""
    return np.diff(x, axis=1, prepend=0.0).T


def _start(parts: Sequence[Any], data: StructureData) -> Start:
    if data.released is None:
        return Start()
    x, v = (list(one) for one in data.released)
    for part in parts:
        if isinstance(part, Release):
            x[part.floor - 1] += part.displacement
            v[part.floor - 1] += part.velocity
    return Start.model_construct(displacement=tuple(x), velocity=tuple(v))


def _at_steps(rows: Array, n: int) -> Array:
    """Inputs at the integration steps, from 0, recovered from inputs recorded at the substeps between them."""
    at = rows[n - 1 :: n]
    first = (n * rows[0] - rows[n - 1]) / (n - 1) if n > 1 else rows[0]
    return np.vstack([first, at])
