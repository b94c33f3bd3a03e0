"""The report of a run: one HTML file that needs nothing else, not even a network."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import Any

from app.reports import page
from app.reports.excitation import excitation
from app.reports.figures import Figures, Panel, station_panels
from app.reports.plan_tables import Group, groups
from app.shown import KINDS, SILENT
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.templates import PAPER
from rths_engine.recordings.run_file import Recording
from rths_engine.results.metrics.decay import free_decay

Measure = tuple[str, str, str, int]  # field of the summary, heading, what it is, decimals
_MEASURES = (
    ("mte_mm", "MTE, mm", "maximum tracking error", 2),
    ("rms_percent", "RMS, %", "root mean square tracking error", 2),
    ("mti_mm2", "MTI, mm²", "maximum tracking indicator", 1),
    ("mee_kNm", "MEE, kN·m", "maximum energy error", 2),
    ("peak_stroke_mm", "Peak stroke, mm", "largest measured displacement", 1),
    ("peak_force_kN", "Peak force, kN", "largest measured force of one damper", 1),
)
_BEYOND = (
    ("fei_delay_ms", "FEI delay, ms", "generalised delay by the frequency evaluation index", 2),
    ("fei_amplitude", "FEI amplitude", "generalised amplitude by the frequency evaluation index", 4),
    ("delay_ms", "Delay, ms", "lag of the largest cross-correlation of command and measured displacement", 2),
    ("nrms_percent", "NRMSE, %", "root mean square tracking error over the range of the command", 2),
    ("peak_error_percent", "Peak error, %", "largest tracking error over the largest command", 2),
    ("energy_error_percent", "HSEE, %", "energy error of the station's dampers over the input energy", 2),
)


def report_html(run: dict[str, Any], recording: Recording, motions: MotionLibrary | None = None) -> str:
    """The report of `run` (a RunOut as JSON) with its `recording`; `motions` finds the stored records besides the bundled."""
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
        measures=_telling(_MEASURES, recording.plan),
        beyond=_telling(_BEYOND, recording.plan),
        results=_results(recording),
        floors_peak=recording.summary["floors_peak_mm"],
        input_energy=recording.summary.get("input_energy_kNm"),
        excitation=excitation(recording, motions or MotionLibrary(None), figures),
        stations=stations,
        floors=_floors(recording, figures),
        decay=_decay(recording),
        parts=_parts(recording),
        origin=_origin(run, recording),
        fixed=_fixed,
    )


def _telling(measures: Sequence[Measure], plan: Plan) -> list[Measure]:
    """Those that say something in the plan's kind of test."""
    return [measure for measure in measures if measure[0] not in SILENT.get(plan.test, ())]


def _verdict(run: dict[str, Any], recording: Recording) -> tuple[str, str]:
    """State and how the sentence that begins with it goes on."""
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


def _results(recording: Recording) -> list[tuple[str, dict[str, float], Any]]:
    """Each station's name and measures, and the paper's as texts, or the word that stands there instead, or None."""
    paper = PAPER.get(recording.plan.template or "")
    rows: list[tuple[str, dict[str, float], Any]] = []
    for index, station in enumerate(recording.summary["stations"]):
        published: Any = None
        if paper and index < 2:
            values = {key: getattr(paper, key, None) for key, *_ in _MEASURES}
            found = {key: _fixed(pair[index], 1) for key, pair in values.items() if pair is not None}
            published = found or "unstable"
        rows.append((station["name"], station, published))
    return rows


def _floors(recording: Recording, figures: Figures) -> list[Panel]:
    named = [(one.key, f"Floor {one.number}") for one in recording.channels if one.role == "x_floor"]
    return [
        figures.against_time("Floor displacements relative to the ground", "Displacement", named[first : first + 4], wide=True)
        for first in range(0, len(named), 4)
    ]


def _decay(recording: Recording) -> list[tuple[str, str]]:
    """Period and damping of the highest floor where it swings freely."""
    plan = recording.plan
    if plan.start.at_rest or plan.forces or plan.motion.kind != "none":
        return []
    floors = [channel for channel in recording.channels if channel.role == "x_floor"]
    found = free_decay(recording.signal(floors[-1].key), recording.dt)
    if found is None:
        return [("Free decay", "too few cycles for period and damping")]
    cycles = f"{found.cycles} cycles of floor {len(floors)}"
    return [
        ("Period of the free decay", f"{found.period:.4g} s, {cycles}"),
        ("Damping ratio", f"{found.ratio * 100:.3g} %, logarithmic decrement of the same cycles"),
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


def _fixed(value: float | None, digits: int) -> str:
    """With fixed decimals and a real minus; a dash where there is none."""
    return "–" if value is None else f"{value:z.{digits}f}".replace("-", "−")


def _clock(moment: str | None) -> str:
    if not moment:
        return "–"
    return datetime.fromisoformat(moment).strftime("%Y-%m-%d %H:%M:%S UTC")
