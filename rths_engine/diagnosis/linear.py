"""A linear model that is fitted to a recording, for recordings that have no plan."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import lsq_linear, minimize_scalar
from scipy.signal import lfilter

from rths_engine.diagnosis.linear_structure import fitted_building, steps
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError, RecordingError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.velocity_drive import VelocityDrive
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.excitation import Drive
from rths_engine.planning.plan import Plan, Station
from rths_engine.planning.reading import read_plan
from rths_engine.planning.shapes import Sine
from rths_engine.recordings.excitation.recorded import FASTEST, STRONGEST, Excitation
from rths_engine.recordings.excitation.smoother import Smoother
from rths_engine.recordings.measured import Measured

# chosen; see docs/decisions/0023
ALPHAS = 1000.0  # largest delay constant
SHORTEST, LONGEST = 1e-3, 10.0  # s, time constant of a drive
GENTLE = 1e-3  # m or V, amplitude of the drive where a plan does not allow the recorded command
NOTHING = 1e-9  # of the force: a smaller share of a spring or a dashpot is rounding
LENGTH = 120  # characters of a name


def linear_plan(recording: Measured, name: str = "") -> Plan:
    """A plan of linear parts that are fitted to the recording, under the recorded excitation.

    - test of a specimen: f = k x + c v + f_0 by least squares with k, c >= 0; f_0 is not a part of the plan
    - test of an actuator, and a recorded command: the first-order delay with the smallest error; for a voltage, a velocity
      drive
    - test of a structure: a shear building (`linear_structure`)

    Raises RecordingError where the recording lacks a channel, where its force acts against the displacement, or where it is of
    a hybrid test: the structure of a hybrid test is that of its controller, which only its plan gives.
    """
    test = recording.test or _kind(recording)
    about = {"name": f"Linear model fitted to {name or recording.title or 'a recording'}"[:LENGTH], "test": test}
    if test == "hybrid":
        fix = "give the plan of this recording"
        raise RecordingError(Issue("recording", "is of a hybrid test, whose structure only its plan gives", None, fix))
    if test == "structure":
        building, words = fitted_building(recording)
        plan = Plan(**about, notes=words, structure=building, **steps(recording))
    else:
        station, words = _station(recording, test)
        drive = Drive(amplitude=GENTLE, shape=Sine())  # replaced by the recorded command
        plan = Plan(**about, notes=words, stations=(station,), drive=drive, controller_rate=1 / recording.dt)
    try:
        return read_plan(Excitation(plan, recording).planned().as_dict())
    except (PlanError, RecordingError):  # the recorded command exceeds what a plan allows; a diagnosis does not use the drive
        if plan.driven:
            return read_plan(plan.as_dict())
        raise


def _kind(recording: Measured) -> str:
    """The kind of test of a recording that does not state it."""
    if recording.numbers("floor"):
        return "structure"
    return "specimen" if recording.has("f_meas") else "actuator"


def _station(recording: Measured, test: str) -> tuple[Station, str]:
    """The station with its fitted parts, and the fit in words."""
    if not recording.has("x_meas"):
        raise RecordingError(Issue("recording", "has no measured displacement (role x_meas) to fit a linear model to"))
    actuator, words = _actuator(recording)
    update: dict[str, Any] = {"name": "Station 1", "compensator": NoCompensation(), "actuator": actuator}
    if test == "specimen":
        specimen, more = _specimen(recording)
        update["specimen"] = specimen
        words = [more, *words]
    return Station(**update), " ".join(words)


def _specimen(recording: Measured) -> tuple[LinearSpecimen, str]:
    if not recording.has("f_meas"):
        raise RecordingError(Issue("recording", "has no measured force (role f_meas) to fit a linear specimen to"))
    force, x = recording.get("f_meas"), recording.get("x_meas")
    moved = x if recording.of_run else Smoother.of(x, recording.dt).smoothed(x)
    columns = np.column_stack([moved, np.gradient(moved, recording.dt), np.ones(len(x))])
    size = np.maximum(np.sqrt(np.mean(columns**2, axis=0)), 1e-300)
    bounds = ([0.0, 0.0, -np.inf], [np.inf] * 3)
    found = lsq_linear(columns / size, force, bounds).x
    found[np.abs(found) < NOTHING * float(np.std(force))] = 0.0
    stiffness, damping, _ = found / size
    if not (stiffness or damping):
        fix = "change the sign of the force or of the displacement in the mapping"
        raise RecordingError(Issue("recording", "has a force that acts against displacement and velocity", None, fix))
    words = f"Spring and dashpot fitted to the recorded force: k = {stiffness:.4g} N/m, c = {damping:.4g} N s/m."
    return LinearSpecimen(stiffness=float(stiffness), damping=float(damping)), words


def _actuator(recording: Measured) -> tuple[Any, list[str]]:
    """The actuator between the recorded command and the displacement; without a command, it follows without delay."""
    follows = FirstOrderDelay(alpha=1, velocity_limit=FASTEST, force_limit=STRONGEST)
    source = next((role for role in ("x_comp", "x_cmd", "drive") if recording.has(role)), None)
    x = recording.get("x_meas")
    if source is None or not np.ptp(recording.get(source)) > 0:
        return follows, []
    command = recording.get(source)
    unit = next(channel.unit for channel in recording.channels if channel.role == source)
    if unit == "V":
        drive = _velocity_drive(command, x, recording.dt)
        fit = f"gain {drive.gain:.4g} m/(s V), time constant {drive.time_constant:.4g} s"
        return drive, [f"Velocity drive fitted to the recorded displacement: {fit}."]

    def error(log_alpha: float) -> float:
        share = math.exp(-log_alpha)
        return float(np.mean((lfilter([share], [1, share - 1], command, zi=[(1 - share) * command[0]])[0] - x) ** 2))

    found = minimize_scalar(error, bounds=(0.0, math.log(ALPHAS)), method="bounded")
    alpha = math.exp(float(found.x)) if found.fun < error(0.0) else 1.0
    lag = 1e3 * (alpha - 1) * recording.dt
    words = f"First-order delay fitted to the recorded displacement: α = {alpha:.4g}, a delay of about {lag:.3g} ms."
    return follows.model_copy(update={"alpha": alpha}), [words]


def _velocity_drive(voltage: Array, x: Array, dt: float) -> VelocityDrive:
    """T y'' + y' = k (u - u_0), integrated once: y = k int u dt - k u_0 t - T y' + y_0, by least squares."""
    time = np.arange(len(x)) * dt
    moved = Smoother.of(x, dt).smoothed(x)
    columns = np.column_stack([np.cumsum(voltage) * dt, time, np.gradient(moved, dt), np.ones(len(x))])
    gain, slope, lag, _ = np.linalg.lstsq(columns, moved, rcond=None)[0]
    if not gain > 0:
        fix = "change the sign of the displacement in the mapping"
        raise RecordingError(Issue("recording", "has a displacement that moves against its voltage", None, fix))
    limits = {"velocity_limit": FASTEST, "force_limit": STRONGEST}
    constant = float(np.clip(-lag, SHORTEST, LONGEST))
    return VelocityDrive(gain=float(gain), time_constant=constant, rest_voltage=float(-slope / gain), **limits)
