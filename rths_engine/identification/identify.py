"""Identify the delay of a station by a short random test, and what it means for the compensator of the plan."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.identification import estimates
from rths_engine.identification.estimates import Fitted, Value
from rths_engine.identification.random_test import RandomTest
from rths_engine.parts.compensators.compensator import TransferSystem
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.connections import emulated, external, predicted
from rths_engine.planning.plan import Plan
from rths_engine.running.opening import opened

# chosen; see docs/decisions/0023
SMALLER = 0.25  # of the amplitude, in the second random test
NOTABLE = 0.02  # relative change of the delay with the amplitude that is reported
COHERENT = 0.9  # mean coherence below which the estimate is called uncertain
POOR = 0.05  # residual of the best model above which it is called a poor description
OF_ACTUATOR = ("alpha_es", "gain", "delay", "frequency", "damping_ratio", "velocity_gain", "lead_time")

TITLES = {"first_order": "First-order delay", "pure_delay": "Pure delay", "second_order": "Second order with dead time"}
PARAMETERS = {
    "alpha": ("Delay constant α", "1", "1"),
    "delay": ("Delay τ", "s", "ms"),
    "gain": ("Static gain", "1", "1"),
    "frequency": ("Natural frequency f", "Hz", "Hz"),
    "damping_ratio": ("Damping ratio ζ", "1", "%"),
    "dead_time": ("Dead time T", "s", "ms"),
}


def identify(plan: Plan, number: int = 1, settings: RandomTest | None = None, on_rig: bool = False) -> dict[str, Any]:
    """The delay of station `number` (from 1) with 95 % intervals, by a random test of its actuator and specimen.

    Values are SI. The test runs twice, at the whole amplitude and at a quarter, because the delay of an actuator may depend on
    it. `suggested` are values of fields of the plan's compensator. An external station is moved only with `on_rig`; without,
    its models are. Raises PlanError where the test cannot run or trips, and RigError where a rig does not answer.
    """
    settings, notes = settings or RandomTest(), []
    if not on_rig:
        plan, notes = emulated(plan), predicted(plan)
    test = settings.plan(plan, number)
    if on_rig and number - 1 not in external(plan):
        fix = "leave --rig out to test its model, or name the rig in the connection of the station"
        raise PlanError(Issue(f"stations.{number - 1}.connection", "has no rig that could be moved", "emulated", fix))
    u, y = _measured(test, number)
    dt = plan.substep
    band = settings.low_frequency, settings.high_frequency
    late, coherence = estimates.pure_delay(u, y, dt, *band)
    begun = min(max(late.delay.value, dt), estimates.LATEST / 2)
    first = estimates.first_order(u, y, dt, band[1], begun)
    fitted = [first, late, estimates.second_order(u, y, dt, band[1], begun)]
    chosen = estimates.best(fitted)
    smaller = estimates.first_order(*_measured(settings.plan(plan, number, SMALLER), number), dt, band[1], begun)
    amplitude = test.drive.amplitude
    rms = float(np.sqrt(np.mean(u**2))), float(np.sqrt(np.mean(np.diff(u) ** 2))) / dt
    return {
        "station": number,
        "name": plan.stations[number - 1].name,
        "seconds": settings.seconds,
        "low_frequency": band[0],
        "high_frequency": band[1],
        "amplitude": amplitude,
        "rms_displacement": rms[0],
        "rms_velocity": rms[1],
        "controller_step": dt,
        "coherence": coherence,
        "models": [_shown(one) for one in fitted],
        "best": chosen.kind,
        "delay": _interval(chosen.delay),
        "smaller_amplitude": {"amplitude": SMALLER * amplitude, "alpha": _interval(smaller.values["alpha"])},
        "suggested": _suggested(plan, number, chosen, rms),
        "notes": [*notes, *_notes(plan, number, chosen, coherence), *_on_amplitude(first, smaller, amplitude)],
    }


def _measured(test: Plan, number: int) -> tuple[Array, Array]:
    """Command and measured displacement (m) of a random test."""
    with opened(test, MotionLibrary(None)) as run:
        while not run.finished:
            run.advance(run.total)
    if run.trip is not None:
        sentence = run.trip.sentence.replace("station 1", f"station {number}")
        raise PlanError(Issue("amplitude", f"trips the random test: {sentence}", test.drive.amplitude, "lower the amplitude"))
    result = run.result("completed", 0.0)
    return result.signal("x_cmd.1"), result.signal("x_meas.1")


def _shown(fitted: Fitted) -> dict[str, Any]:
    values = []
    for key, value in fitted.values.items():
        label, unit, shown = PARAMETERS[key]
        values.append(
            {"key": key, "label": label, "unit": unit, "shown_label": units.pretty(shown), "factor": units.factor(shown)}
            | _interval(value)
            | {"determined": key not in fitted.undetermined}
        )
    return {
        "kind": fitted.kind,
        "title": TITLES[fitted.kind],
        "parameters": values,
        "delay": _interval(fitted.delay),
        "residual": fitted.residual,
    }


def _interval(value: Value) -> dict[str, float]:
    return {"value": value.value, "low": value.low, "high": value.high}


def _suggested(plan: Plan, number: int, chosen: Fitted, rms: tuple[float, float]) -> list[dict[str, Any]]:
    """Fields of the plan's compensator that describe its actuator, with their values for the best model."""
    compensator = plan.stations[number - 1].compensator
    late = chosen.delay.value
    numerator: Any = (1.0,)
    denominator: Any = (late, 1.0)
    if chosen.kind == "second_order":
        keys = ("gain", "frequency", "damping_ratio", "dead_time")
        gain, frequency, damping, late = (chosen.values[key].value for key in keys)
        omega = 2 * math.pi * frequency
        numerator, denominator = (gain,), (omega**-2, 2 * damping / omega, 1.0)
    if chosen.kind != "first_order" and late > 0:  # the dead time as a Pade approximation of second order
        numerator = np.polymul(numerator, (late**2 / 12, -late / 2, 1.0))
        denominator = np.polymul(denominator if chosen.kind == "second_order" else (1.0,), (late**2 / 12, late / 2, 1.0))
    system = TransferSystem(
        tuple(float(one) for one in numerator),
        tuple(float(one) for one in denominator),
        rate=plan.controller_rate,
        step=plan.step,
        displacement=rms[0],
        velocity=rms[1],
        displacement_noise=plan.stations[number - 1].noise.displacement,
    )
    tuned = type(compensator).tuned_for(system)
    found = []
    for name in OF_ACTUATOR:
        field = type(compensator).model_fields.get(name)
        if field is not None and name not in chosen.undetermined:
            extra: Any = field.json_schema_extra
            found.append(
                {
                    "field": name,
                    "path": f"stations.{number - 1}.compensator.{name}",
                    "label": field.title,
                    "value": float(getattr(tuned, name)),
                    "present": float(getattr(compensator, name)),
                    "shown_label": units.pretty(extra["shown"]),
                    "factor": extra["factor"],
                }
            )
    return found


def _notes(plan: Plan, number: int, chosen: Fitted, coherence: float) -> list[str]:
    found = []
    if coherence < COHERENT:
        found.append(
            f"Mean coherence {coherence:.2f}: noise or nonlinearity takes a large share of the response. "
            "Raise the amplitude or the duration."
        )
    if chosen.residual > POOR:
        found.append(f"No model describes the response well: the best leaves {100 * chosen.residual:.1f} % of it.")
    if plan.stations[number - 1].compensator.kind == "none":
        found.append("The plan compensates no delay: choose a compensator to use this estimate.")
    return found


def _on_amplitude(first: Fitted, smaller: Fitted, amplitude: float) -> list[str]:
    """What the test at a quarter of the amplitude says of the delay."""
    large, small = first.values["alpha"], smaller.values["alpha"]
    spread = math.hypot(large.high - large.value, small.high - small.value)
    change = large.value - small.value
    if abs(change) <= max(spread, NOTABLE * large.value):
        return []
    way = "grows" if change > 0 else "falls"
    return [
        f"The delay depends on the amplitude: α {way} from {small.value:.1f} at {1e3 * SMALLER * amplitude:.3g} mm to "
        f"{large.value:.1f} at {1e3 * amplitude:.3g} mm. Identify at the amplitude of the test, or use an adaptive compensator."
    ]
