"""The report of a run: one HTML file that needs nothing else, not even a network."""

from __future__ import annotations

from datetime import datetime
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from app.reports.figures import Figures, Panel, spectrum_panel, station_panels
from app.reports.plan_tables import Group, groups
from rths_engine.errors import MotionError
from rths_engine.ground_motions import Motion, MotionLibrary, response_spectrum, spectral_acceleration
from rths_engine.recording import Recording
from rths_engine.templates import PAPER
from rths_engine.units import STANDARD_GRAVITY

_TEMPLATES = Path(__file__).parents[2] / "frontend" / "templates"
_MEASURES = (
    ("mte_mm", "MTE, mm", "maximum tracking error", 2),
    ("rms_percent", "RMS, %", "root mean square tracking error", 2),
    ("mti_mm2", "MTI, mm²", "maximum tracking indicator", 1),
    ("mee_kNm", "MEE, kN·m", "maximum energy error", 2),
    ("peak_stroke_mm", "Peak stroke, mm", "largest measured displacement", 1),
    ("peak_force_kN", "Peak force, kN", "largest measured force of one damper", 1),
)
_PERIODS = np.concatenate([[0.0], np.geomspace(0.02, 4.0, 160)])  # s
_DAMPING = 0.05


def report_html(run: dict[str, Any], recording: Recording, motions: MotionLibrary | None = None) -> str:
    """The report of `run` (a RunOut as JSON) with its `recording`; `motions` finds the stored records besides the bundled."""
    figures = Figures(recording)
    stations = [
        (number, station.name, station_panels(figures, f"s{number}", station.name))
        for number, station in enumerate(recording.plan.stations, start=1)
    ]
    motion = _motion(recording, motions or MotionLibrary(None), figures)
    floors = _floors(recording, figures)
    return _template().render(
        plan=recording.plan,
        verdict=_verdict(run, recording),
        facts=_facts(run, recording),
        measures=_MEASURES,
        results=_results(recording),
        floors_peak=recording.summary["floors_peak_mm"],
        motion=motion,
        stations=stations,
        floors=floors,
        parts=_parts(recording),
        origin=_origin(run, recording),
        plotly=_plotly(),
        fixed=_fixed,
    )


def _verdict(run: dict[str, Any], recording: Recording) -> tuple[str, str]:
    """State and how the sentence that begins with it goes on."""
    simulated, trip = recording.summary["simulated_s"], recording.summary["trip"]
    if recording.status == "completed":
        return "completed", f": all {simulated:.2f} s were simulated; no safety limit was exceeded."
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


def _motion(recording: Recording, motions: MotionLibrary, figures: Figures) -> dict[str, Any]:
    plan = recording.plan
    period = float(plan.periods()[0])
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
            ("Step and length", f"{unscaled.dt:g} s, {len(unscaled.acceleration)} samples, {unscaled.duration:.2f} s"),
            ("PGA of the record", f"{unscaled.pga / STANDARD_GRAVITY:.3f} g"),
            ("Scaling", f"{type(plan.motion.scale).title.lower()}, record × {factor:.4g}"),
        ]
    if applied is None:
        return {"facts": facts, "panels": panels}
    sa_t1 = spectral_acceleration(applied, period, _DAMPING) / STANDARD_GRAVITY
    spectrum = response_spectrum(applied.acceleration, applied.dt, _PERIODS, _DAMPING) / STANDARD_GRAVITY
    facts += [
        ("PGA as applied", f"{applied.pga / STANDARD_GRAVITY:.3f} g"),
        ("First period T₁", f"{period:.3f} s (analytical substructure, undamped)"),
        ("Sa(T₁) as applied", f"{sa_t1:.3f} g at {_DAMPING * 100:g} % damping"),
    ]
    if applied.provenance:
        facts.append(("Provenance", applied.provenance))
    panels.append(spectrum_panel(_PERIODS, spectrum, period, sa_t1, _DAMPING))
    return {"facts": [(label, text) for label, text in facts if text], "panels": panels}


def _recorded_motion(recording: Recording) -> Motion | None:
    """The ground acceleration at integration steps as recorded, where the record itself is out of reach."""
    substeps = recording.plan.substeps
    samples = recording.signal("ag")[substeps - 1 :: substeps]
    return Motion("recorded", "recorded", recording.dt * substeps, samples) if len(samples) > 1 else None


def _recorded_facts(recording: Recording) -> list[tuple[str, str]]:
    name = getattr(recording.plan.motion, "record", recording.plan.motion.kind)
    scale = type(recording.plan.motion.scale).title.lower()
    return [("Record", name), ("Scaling", scale), ("Spectrum of", "the ground acceleration in this recording")]


def _floors(recording: Recording, figures: Figures) -> list[Panel]:
    keys = [channel.key for channel in recording.channels if channel.group == "floors"]
    named = [(key, f"Floor {number}") for number, key in enumerate(keys, start=1)]
    return [
        figures.against_time("Floor displacements relative to the ground", "Displacement", named[first : first + 4], wide=True)
        for first in range(0, len(named), 4)
    ]


def _parts(recording: Recording) -> list[tuple[str, list[Group]]]:
    plan = recording.plan
    found = [
        ("Ground motion", groups(type(plan.motion).title, plan.motion)),
        ("Structure", groups(type(plan.structure).title, plan.structure)),
        ("Test", groups("Time and pace", plan, leave_out=("motion", "structure", "stations"))),
    ]
    found += [(f"Station {j}: {station.name}", groups("Station", station)) for j, station in enumerate(plan.stations, start=1)]
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


def _fixed(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}"
    return text.replace("-", "−") if float(text) else text.removeprefix("-")


def _clock(moment: str | None) -> str:
    if not moment:
        return "–"
    return datetime.fromisoformat(moment).strftime("%Y-%m-%d %H:%M:%S UTC")


@cache
def _plotly() -> str:
    """plotly.min.js of the installed wheel."""
    return (files("plotly") / "package_data" / "plotly.min.js").read_text(encoding="utf-8")


@cache
def _template() -> Any:
    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return environment.get_template("report.html")
