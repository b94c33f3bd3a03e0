"""The report of a run: one HTML file that needs no network."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from app.reports import page
from app.reports.excitation import excitation
from app.reports.figures import Figures, Panel, station_panels
from app.reports.plan_tables import Group, groups
from app.reports.results import results
from app.shown import KINDS
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.recordings.run_file import Recording
from rths_engine.results.metrics.decay import free_decay


def report_html(run: dict[str, Any], recording: Recording, motions: MotionLibrary | None = None) -> str:
    """The report of `run` (a RunOut as JSON) with its `recording`. `motions` finds the stored and the bundled records."""
    figures = Figures(recording)
    stations = [
        (number, station.name, station_panels(figures, number, station, recording.plan.test))
        for number, station in enumerate(recording.plan.stations, start=1)
    ]
    return page.render(
        "report.html",
        plan=recording.plan,
        verdict=_verdict(run, recording),
        facts=_facts(run, recording),
        kind=KINDS[recording.plan.test],
        results=results(recording),
        excitation=excitation(recording, motions or MotionLibrary(None), figures),
        stations=stations,
        floors=_floors(recording, figures),
        decay=_decay(recording),
        parts=_parts(recording),
        origin=_origin(run, recording),
    )


def _verdict(run: dict[str, Any], recording: Recording) -> tuple[str, str]:
    """The status, and the rest of the sentence that begins with the status."""
    simulated, trip = recording.summary["simulated_s"], recording.summary["trip"]
    if recording.status == "completed":
        limits = "; no safety limit was exceeded" if recording.plan.stations else ""
        return "completed", f": all {simulated:.2f} s were simulated{limits}."
    if trip:
        return "tripped", trip["sentence"].removeprefix("Tripped").replace(" -", " −")
    return recording.status, f": {run.get('reason') or f'stopped at {simulated:.2f} s.'}"


def _facts(run: dict[str, Any], recording: Recording) -> list[tuple[str, str]]:
    elapsed, simulated = recording.summary["elapsed_s"], recording.summary["simulated_s"]
    facts = [
        ("Run", str(run.get("number") or run.get("id", "–"))),
        ("Submitted by", run.get("submitted_by") or "–"),
        ("Submitted", _clock(run.get("submitted_at"))),
        ("Started", _clock(run.get("started_at"))),
        ("Finished", _clock(run.get("finished_at"))),
        ("Simulated", f"{simulated:.2f} s of test in {elapsed:.2f} s"),
        ("Template", recording.plan.template or "none"),
    ]
    return facts + ([("Notes", recording.plan.notes)] if recording.plan.notes else [])


def _floors(recording: Recording, figures: Figures) -> list[Panel]:
    named = [(one.key, f"Floor {one.number}") for one in recording.channels if one.role == "x_floor"]
    return [
        figures.against_time("Floor displacements relative to the ground", "Displacement", named[first : first + 4], wide=True)
        for first in range(0, len(named), 4)
    ]


def _decay(recording: Recording) -> list[tuple[str, str]]:
    """Period and damping of the highest floor in free vibration."""
    plan = recording.plan
    if plan.start.at_rest or plan.forces or plan.motion.kind != "none":
        return []
    floors = [channel for channel in recording.channels if channel.role == "x_floor"]
    found = free_decay(recording.signal(floors[-1].key), recording.dt)
    if found is None:
        return [("Free decay", "too few cycles to determine period and damping")]
    cycles = f"{found.cycles} cycles of floor {len(floors)}"
    return [
        ("Period of the free decay", f"{found.period:.4g} s, {cycles}"),
        ("Damping ratio", f"{found.ratio * 100:.3g} %, from the logarithmic decrement of the same cycles"),
    ]


def _parts(recording: Recording) -> list[tuple[str, list[Group]]]:
    plan = recording.plan
    found = []
    if plan.driven:
        found.append(("Drive", groups("Drive", plan.drive)))
    if plan.motion.kind != "none":
        found.append(("Ground motion", groups(type(plan.motion).title, plan.motion)))
    found += [(f"Force on floor {force.floor}", groups("Force", force)) for force in plan.forces]
    if not plan.start.at_rest:
        found.append(("Start", groups("Start", plan.start)))
    if plan.structure.kind != "none":
        found.append(("Structure", groups(type(plan.structure).title, plan.structure)))
    moved = ("motion", "forces", "start", "drive", "structure", "stations")
    found.append(("Test", groups("Time and pace", plan, plan.test, leave_out=moved)))
    for number, station in enumerate(plan.stations, start=1):
        found.append((f"Station {number}: {station.name}", groups("Station", station, plan.test)))
    return found


def _origin(run: dict[str, Any], recording: Recording) -> list[tuple[str, str]]:
    stored = run.get("recording") or {}
    return [
        ("Run identifier", str(run.get("id", "–"))),
        ("Plan digest (SHA-256)", recording.plan.digest),
        ("Seed of the sensor noise", str(recording.plan.seed)),
        ("Engine version", str(recording.attrs.get("code_version", run.get("code_version", "–")))),
        ("Attempt", str(run.get("attempt", "–"))),
        ("Recording (SHA-256)", str(stored.get("sha256", "–"))),
        ("Recording", f"{len(recording.signals)} substeps of {recording.dt * 1e3:.4g} ms, {len(recording.channels)} channels"),
    ]


def _clock(moment: str | None) -> str:
    if not moment:
        return "–"
    return datetime.fromisoformat(moment).strftime("%Y-%m-%d %H:%M:%S UTC")
