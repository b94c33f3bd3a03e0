"""The excitation of a test as sections of its report: ground motion, forces on floors, or the drive of a station."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from app.reports.figures import Figures, Panel, spectrum_panel
from rths_engine.foundation.errors import MotionError
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import Motion, MotionLibrary, response_spectrum, spectral_acceleration
from rths_engine.planning.checks import peaks
from rths_engine.planning.kinds_of_test import DRIVEN
from rths_engine.planning.model import Model
from rths_engine.recordings.run_file import Recording

_PERIODS = np.concatenate([[0.0], np.geomspace(0.02, 4.0, 160)])  # s
_DAMPING = 0.05


class Section(NamedTuple):
    """The part of a report on one excitation: facts and plots."""

    title: str
    facts: list[tuple[str, str]]
    panels: list[Panel]


def excitation(recording: Recording, motions: MotionLibrary, figures: Figures) -> list[Section]:
    """One section for each excitation of the test."""
    plan = recording.plan
    found = [_drive(recording)] if plan.test in DRIVEN else []
    if recording.summary.get("client"):
        found.append(_client(recording.summary["client"]))
    if plan.motion.kind != "none":
        found.append(_ground(recording, motions, figures))
    if plan.forces:
        found.append(_forces(recording, figures))
    if not plan.start.at_rest:
        found.append(_start(recording))
    return found


def _drive(recording: Recording) -> Section:
    plan = recording.plan
    duration = plan.length(0.0)
    peak, velocity = peaks(plan.drive, duration, plan.controller_rate)
    limits = plan.stations[0].limits
    facts = [
        ("Shape", type(plan.drive.shape).title),
        ("Peak displacement", f"{peak * 1e3:.4g} mm (limit {limits.displacement * 1e3:g} mm)"),
        ("Largest velocity", f"{velocity * 1e3:.4g} mm/s (limit {limits.velocity * 1e3:g} mm/s)"),
        ("Duration", f"{duration:g} s"),
    ]
    return Section("Drive", facts, [])


def _client(client: dict[str, Any]) -> Section:
    """The program that computed the structure: its steps, and the warnings about it."""
    took = client["step_ms"]
    facts = [
        ("Client", f"{client['peer']}, by {client['transport'].upper()}"),
        ("Steps of the client", str(client["steps"])),
        ("End", client["ended"]),
    ]
    if took["median"] is not None:
        words = f"median {took['median']:.3g} ms, 95 % within {took['p95']:.3g} ms, longest {took['longest']:.3g} ms"
        facts.append(("Wall time of a step", words))
    if client["iterations"]:
        followed = f"{client['iterations']}; largest difference at a commit {client['unfollowed_m'] * 1e3:.3g} mm"
        facts.append(("Displacements that were not followed", followed))
    if client["waits"]:
        waited = f"{client['waits']}, the longest {client['longest_wait_s'] * 1e3:.3g} ms"
        facts.append(("Ramps that began late, as the client was late", waited))
    return Section("Client", [*facts, *(("Warning", one) for one in client["warnings"])], [])


def _forces(recording: Recording, figures: Figures) -> Section:
    panels = []
    for channel in recording.channels:
        if channel.role == "force_ext":
            panels.append(figures.against_time(channel.label, "Force", [(channel.key, channel.label)], wide=True))
    return Section("Forces", [], panels)


def _start(recording: Recording) -> Section:
    start = recording.plan.start
    given = [("Displacement of the floors", start.displacement, "mm"), ("Velocity of the floors", start.velocity, "mm/s")]
    facts = [
        (label, f"{', '.join(f'{value * 1e3:.4g}' for value in values)} {unit}") for label, values, unit in given if values
    ]
    return Section("Start", facts, [])


def _ground(recording: Recording, motions: MotionLibrary, figures: Figures) -> Section:
    plan = recording.plan
    period = float(Model(plan).periods[0])
    panels = [figures.against_time("Ground acceleration", "Ground acceleration", [("ag", "Ground acceleration")])]
    try:
        unscaled = plan.motion.unscaled(motions)
        factor = plan.motion.scale.factor_for(unscaled, period)
    except MotionError:
        applied, facts = _recorded_motion(recording), _recorded_facts(recording)
    else:
        applied = unscaled.scaled(factor)
        facts = [
            ("Record", unscaled.title),
            ("Event", unscaled.event),
            ("Station", unscaled.station),
            ("Component", unscaled.component),
            ("Time step and length", f"{unscaled.dt:g} s, {len(unscaled.acceleration)} samples, {unscaled.duration:.2f} s"),
            ("PGA of the record", f"{unscaled.pga / STANDARD_GRAVITY:.3f} g"),
            ("Scaling", f"{type(plan.motion.scale).title.lower()}, record × {factor:.4g}"),
        ]
    if applied is None:
        return Section("Ground motion", facts, panels)
    sa_t1 = spectral_acceleration(applied, period, _DAMPING) / STANDARD_GRAVITY
    spectrum = response_spectrum(applied.acceleration, applied.dt, _PERIODS, _DAMPING) / STANDARD_GRAVITY
    facts += [
        ("PGA of the applied motion", f"{applied.pga / STANDARD_GRAVITY:.3f} g"),
        ("First period T₁", f"{period:.3f} s (analytical substructure, undamped)"),
        ("Sa(T₁) of the applied motion", f"{sa_t1:.3f} g at {_DAMPING * 100:g} % damping"),
    ]
    if applied.provenance:
        facts.append(("Provenance", applied.provenance))
    panels.append(spectrum_panel(_PERIODS, spectrum, period, sa_t1, _DAMPING))
    return Section("Ground motion", [(label, text) for label, text in facts if text], panels)


def _recorded_motion(recording: Recording) -> Motion | None:
    """The recorded ground acceleration at integration steps, used when the record file is not available."""
    substeps = recording.plan.substeps
    samples = recording.signal("ag")[substeps - 1 :: substeps]
    return Motion("recorded", "recorded", recording.dt * substeps, samples) if len(samples) > 1 else None


def _recorded_facts(recording: Recording) -> list[tuple[str, str]]:
    name = getattr(recording.plan.motion, "record", recording.plan.motion.kind)
    scale = type(recording.plan.motion.scale).title.lower()
    return [("Record", name), ("Scaling", scale), ("Source of the spectrum", "ground acceleration in this recording")]
