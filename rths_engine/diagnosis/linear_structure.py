"""A shear building that is fitted to the recorded motions of its floors."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import welch

from rths_engine.diagnosis import recorded
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.structures.shear_building import ShearBuilding, Storey
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured

# chosen; see docs/decisions/0023
MASS = 1000.0  # kg of each floor, where no force was recorded: the motion of the ground gives only ratios
STEP = 0.005  # s, longest integration step
LONGEST = 20_000  # samples that are fitted
MOST = 12  # storeys
DAMPINGS = (0.01, 0.05)  # damping ratios tried first
AROUND = (0.8, 0.9, 1.0, 1.1, 1.25)  # first frequencies tried first, over that of the spectrum
LEAST_DAMPING, MOST_DAMPING = 1e-4, 0.5
STEP_OF_FIT = 1e-5  # of a logarithm, for slopes
TAPERS = (1.0, 0.5, 2.0)  # stiffness and mass of the top over those of the first storey, tried one after the other
GOOD = 0.05  # relative error of a fit after which no other start is tried
USELESS = 0.9  # relative error: a larger one says that the building does not move as recorded
TOP_SHARE = 0.05  # of the largest power: the lowest peak above it is that of the first mode


def fitted_building(recording: Measured) -> tuple[ShearBuilding, str]:
    """The shear building with the smallest error of the simulated floor motions, and the fit in words.

    Stiffness and mass of each storey are fitted where all floors were measured, else one stiffness and equal masses; with them
    the damping ratio. Without recorded forces, the mass of the first floor is MASS. Raises RecordingError where no floor was
    measured, or where the building moves otherwise than recorded.
    """
    return _Fit.of(recording).building()


def steps(recording: Measured) -> dict[str, Any]:
    """Controller rate and integrator: the sampling step of the recording, divided into steps of at most STEP."""
    finer = 1 if recording.of_run else max(1, math.ceil(recording.dt / STEP - 1e-9))
    dt = recording.dt / finer
    return {"controller_rate": 1 / dt, "integrator": CrIntegrator(dt=dt, substeps=1)}


@dataclass(frozen=True)
class _Fit:
    recording: Measured
    floors: int
    each: bool  # whether every floor was measured
    forced: bool

    @classmethod
    def of(cls, recording: Measured) -> _Fit:
        channels = [one for one in recording.channels if one.role in recorded.FLOORS and one.number and np.ptp(one.values) > 0]
        if not channels:
            raise RecordingError(Issue("recording", "has no measured motion of a floor to fit a linear structure to"))
        numbers = {int(one.number or 1) for one in channels}
        if max(numbers) > MOST:
            fix = "give the plan of this structure"
            raise RecordingError(Issue("recording", f"has more than {MOST} floors to fit a structure to", max(numbers), fix))
        forced = any(one.role == "force_ext" for one in recording.channels)
        short = replace(recording, channels=tuple(replace(one, values=one.values[:LONGEST]) for one in recording.channels))
        return cls(short, max(numbers), len(numbers) == max(numbers), forced)

    def building(self) -> tuple[ShearBuilding, str]:
        component: Any
        component, data = recorded.components(self.plan(self.at(self.first, DAMPINGS[0])), self.recording, "recording")[0]
        measured, spread = data.measured, np.std(data.measured, axis=1, keepdims=True)

        def left(z: Array) -> Array:
            trial = replace(component, plan=self.plan(z))
            difference = trial.predicted(component.base, data) - measured
            difference -= np.mean(difference, axis=1, keepdims=True)  # the zero of a sensor
            found: Array = np.nan_to_num(difference / np.maximum(spread, 1e-300), nan=1e3, posinf=1e3, neginf=-1e3).ravel()
            return found

        def scaled(z: Array) -> Array:
            """The numbers with masses and stiffnesses that give the recorded size of a motion by forces alone."""
            if not self.forced or data.ground.any():
                return z
            ours = replace(component, plan=self.plan(z)).predicted(component.base, data)
            size = float(np.vdot(ours, measured)) / max(float(np.vdot(ours, ours)), 1e-300)
            shares = np.log(np.exp(z) / size) if size > 0 else z
            shares[-1 - self.masses] = z[-1 - self.masses]  # the damping ratio
            return shares

        tapers = TAPERS if self.each and self.floors > 1 else TAPERS[:1]
        error, best = math.inf, np.zeros(0)
        for taper in tapers:  # two different buildings can have the same frequencies
            tried = [scaled(self.at(share * self.first, damping, taper)) for share in AROUND for damping in DAMPINGS]
            start = min(tried, key=lambda z: float(np.mean(left(z) ** 2)))
            found = least_squares(left, start, method="lm", diff_step=STEP_OF_FIT, xtol=1e-7, ftol=1e-9)
            size = float(np.sqrt(np.mean(found.fun**2)))
            if size < error:
                error, best = size, found.x
            if error < GOOD:
                break
        if not error <= USELESS:
            problem = f"does not move like a linear structure: the best fit has a relative error of {100 * error:.3g} %"
            fix = "import the part of the recording that begins at the release or with the excitation"
            raise RecordingError(Issue("recording", problem, None, fix))
        building = self.plan(best).structure
        assert isinstance(building, ShearBuilding)
        return building, self.words(building, error)

    def at(self, frequency: float, damping: float, taper: float = 1.0) -> Array:
        """The numbers of a building with about this first frequency (Hz): logarithms of k (N/m), damping ratio and m (kg).

        Stiffnesses and masses change towards the top, to `taper` times those of the first storey.
        """
        shape = 2 * math.sin(math.pi / (2 * (2 * self.floors + 1)))
        stiffness = MASS * (2 * math.pi * frequency / shape) ** 2
        shares = np.linspace(1.0, taper, self.floors)
        stiffnesses = stiffness * (shares if self.each else np.ones(1))
        return np.log([*stiffnesses, damping, *MASS * shares[len(shares) - self.masses :]])

    @property
    def masses(self) -> int:
        """Number of masses that are fitted, counted from the highest floor."""
        return (self.floors if self.each else 1) - (0 if self.forced else 1)

    def plan(self, z: Array) -> Plan:
        """The plan of the building of these numbers. The recorded excitation is no part of it."""
        values = np.exp(np.clip(z, -30, 40))
        count = self.floors if self.each else 1
        stiffnesses = np.broadcast_to(values[:count], (self.floors,))
        fitted = np.clip(values[count + 1 :], 1e-3, 1e9)
        masses = np.concatenate([np.full(self.floors - len(fitted), MASS), fitted]) if self.each or not self.forced else fitted
        masses = np.broadcast_to(masses, (self.floors,))
        pairs = zip(masses, stiffnesses, strict=True)
        storeys = tuple(Storey(mass=float(m), stiffness=float(np.clip(k, 1e-3, 1e13))) for m, k in pairs)
        damping = float(np.clip(values[count], LEAST_DAMPING, MOST_DAMPING))
        building = ShearBuilding(storeys=storeys, damping_ratio=damping)
        return Plan(test="structure", structure=building, duration=1.0, **steps(self.recording))

    @property
    def first(self) -> float:
        """First frequency (Hz): the lowest high peak of the mean spectrum of the floors, over that of the ground."""
        samples, dt = self.recording.samples, self.recording.dt
        length = min(samples, max(256, samples // 4))

        def power(values: Array) -> tuple[Array, Array]:
            frequency, found = welch(values - np.mean(values), 1 / dt, nperseg=length)
            return frequency[1:], found[1:]

        rows = [one.values for one in self.recording.channels if one.role in recorded.FLOORS and np.ptp(one.values) > 0]
        frequency = power(rows[0])[0]
        total = np.mean([power(row)[1] / np.var(row) for row in rows], axis=0)
        if self.recording.has("ag") and np.ptp(self.recording.get("ag")) > 0:
            ground = power(self.recording.get("ag"))[1]
            total = total / (ground + 0.01 * float(np.max(ground)))
        peaks = [
            place
            for place in range(1, len(total) - 1)
            if total[place] >= max(total[place - 1], total[place + 1], TOP_SHARE * float(np.max(total)))
        ]
        return float(frequency[peaks[0] if peaks else int(np.argmax(total))])

    def words(self, building: ShearBuilding, error: float) -> str:
        stiffness = ", ".join(f"{one.stiffness:.4g}" for one in building.storeys)
        scale = "" if self.forced else f"; {MASS:g} kg is a scale, because the recording gives only ratios"
        mass = ", ".join(f"{one.mass:.4g}" for one in building.storeys)
        return (
            f"Shear building fitted to the recorded floors: k = {stiffness} N/m from storey 1 on, damping ratio "
            f"{100 * building.damping_ratio:.3g} %, masses {mass} kg{scale}. "
            f"The relative error of the fit is {100 * error:.3g} %."
        )
