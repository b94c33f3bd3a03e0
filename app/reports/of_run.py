"""The report of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from app.reports.deadlines import deadlines
from app.reports.document import (
    Block,
    Document,
    Facts,
    Figures,
    Head,
    Heading,
    Letterhead,
    Section,
    Signatures,
    Table,
    Tables,
    Text,
    Verdict,
)
from app.reports.excitation import Section as Excited
from app.reports.excitation import excitation
from app.reports.figures import Figures as Drawn
from app.reports.figures import Panel, station_panels
from app.reports.made import made
from app.reports.plan_tables import Grid, Group, groups
from app.reports.record_of_test import clock, record
from app.reports.results import results
from app.shown import KINDS
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.connections import external
from rths_engine.recordings.run_file import Recording
from rths_engine.results.metrics.decay import free_decay

SAME = "A run with the same plan digest, seed and engine version gives the same numbers to the bit."
OF_CLIENT = (
    "The client computed the structure, and its program is in no digest. The same plan digest, seed and engine version give "
    "the same numbers only where the client sends the same displacements in the same order."
)
OF_RIGS = (
    "The plan digest, the seed and the engine version fix the computed part. The external stations are outside this program: a "
    "run with the same three gives the same numbers only as far as their rigs repeat."
)
TONES = {"completed": "good", "tripped": "bad"}


@dataclass(frozen=True, slots=True)
class Annotation:
    """A note of a person at a time or over a span (s) of a run, on one station or on the whole test."""

    from_s: float
    to_s: float | None
    station: int | None
    text: str
    by: str
    written: str


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a report shows besides its subject: letterhead, roles that sign, and annotations."""

    letterhead: Letterhead = field(default_factory=Letterhead)
    signatures: Sequence[str] = ()
    annotations: Sequence[Annotation] = ()


def document(
    run: Mapping[str, Any],
    recording: Recording,
    motions: MotionLibrary | None = None,
    around: Surroundings | None = None,
) -> Document:
    """The report of `run` (a RunOut as JSON) with its `recording`. `motions` finds the stored and the bundled records."""
    around = around or Surroundings()
    figures = Drawn(recording)
    marks = _marks(recording, around.annotations)
    plan = recording.plan
    sections = [
        Section("Results", results(recording)),
        *_notes(run, recording, around.annotations),
        *_excitations(excitation(recording, motions or MotionLibrary(None), figures), marks),
        *_stations(recording, figures, marks),
        *_structure(recording, figures, marks),
        *deadlines(recording.summary.get("timing")),
        Section("Test plan", _plan(recording)),
        Section("Test record", record(run, recording)),
        Section("Repeating this test", _repeat(run, recording), together=True),
    ]
    if around.signatures:
        sections.append(Section("Signatures", [Signatures(around.signatures)], together=True))
    return Document(
        kind=f"{KINDS[plan.test]} · test report",
        title=str(run.get("name") or plan.name),
        verdict=_verdict(run, recording),
        facts=_facts(run, recording),
        sections=sections,
        subject=_subject(run, recording),
        made=made(),
        letterhead=around.letterhead,
    )


def _verdict(run: Mapping[str, Any], recording: Recording) -> Verdict:
    """The status, and the rest of the sentence that begins with the status."""
    simulated, trip = recording.summary["simulated_s"], recording.summary["trip"]
    tone = TONES.get(recording.status, "")
    if recording.status == "completed":
        limits = "; no safety limit was exceeded" if recording.plan.stations else ""
        return Verdict(f": all {simulated:.2f} s were simulated{limits}.", "Completed", tone)
    if trip:
        return Verdict(trip["sentence"].removeprefix("Tripped").replace(" -", " −"), "Tripped", tone)
    return Verdict(f": {run.get('reason') or f'stopped at {simulated:.2f} s.'}", recording.status.capitalize(), tone)


def _subject(run: Mapping[str, Any], recording: Recording) -> str:
    number = f"Run {run['number']} · " if run.get("number") else ""
    return f"{number}plan {recording.plan.digest[:12]}"


def _facts(run: Mapping[str, Any], recording: Recording) -> list[tuple[str, str]]:
    elapsed, simulated = recording.summary["elapsed_s"], recording.summary["simulated_s"]
    tags = run.get("tags") or []
    return [
        ("Run", str(run.get("number") or run.get("id", "–"))),
        ("Submitted by", run.get("submitted_by") or "–"),
        ("Submitted", clock(run.get("submitted_at"))),
        ("Started", clock(run.get("started_at"))),
        ("Finished", clock(run.get("finished_at"))),
        ("Simulated", f"{simulated:.2f} s of test in {elapsed:.2f} s"),
        ("Template", recording.plan.template or "none"),
        *([("Tags", ", ".join(tags))] if tags else []),
    ]


def _notes(run: Mapping[str, Any], recording: Recording, annotations: Sequence[Annotation]) -> list[Section]:
    """Notes of the plan and of the run, and the annotations."""
    found = []
    notes = [("Plan", recording.plan.notes), ("Run", str(run.get("notes") or ""))]
    if any(text for _, text in notes):
        found.append(Section("Notes", [Facts([(name, text) for name, text in notes if text], long=True)]))
    if annotations:
        stations = [station.name for station in recording.plan.stations]
        rows = [
            [str(number), _span(one), _of(one.station, stations), one.text, one.by or "–", clock(one.written)]
            for number, one in enumerate(annotations, start=1)
        ]
        heads = [
            Head("No.", share=0.5), Head("Time", share=1.3), Head("Station", share=1.4), Head("Note", share=4.5),
            Head("By", share=1.4), Head("Written", share=1.8),
        ]  # fmt: skip
        found.append(Section("Annotations", [Table("Notes on the charts, with the numbers of their marks", heads, rows)]))
    return found


def _span(one: Annotation) -> str:
    return f"{one.from_s:.2f} s" if one.to_s is None else f"{one.from_s:.2f} to {one.to_s:.2f} s"


def _of(station: int | None, names: Sequence[str]) -> str:
    if station is None:
        return "whole test"
    return f"{station} · {names[station - 1]}" if station <= len(names) else f"{station}"


def _marks(recording: Recording, annotations: Sequence[Annotation]) -> list[dict[str, Any]]:
    """The marks on charts over time: numbered annotations and the trip; `station` is None on every chart."""
    marks: list[dict[str, Any]] = [
        {"from": one.from_s, "to": one.to_s, "text": str(number), "station": one.station}
        for number, one in enumerate(annotations, start=1)
    ]
    trip = recording.summary["trip"]
    if trip and len(recording.signals):  # the sample that tripped is not recorded
        at = min(trip["time_s"], float(recording.time[-1]))
        marks.append({"from": at, "to": None, "text": "trip", "station": trip["station"], "trip": True})
    return marks


def _marked(panels: Sequence[Panel], marks: Sequence[Mapping[str, Any]], station: int | None) -> list[Panel]:
    """The panels with the marks that concern a station; only charts over time have them."""
    own = [dict(one) for one in marks if station is None or one["station"] in (None, station)]
    return [replace(one, spec={**one.spec, "marks": own}) if own and one.spec["x"] == "Time, s" else one for one in panels]


def _excitations(excited: Sequence[Excited], marks: list[dict[str, Any]]) -> list[Section]:
    found = []
    for one in excited:
        blocks: list[Block] = [Facts(one.facts)] if one.facts else []
        found.append(Section(one.title, [*blocks, Figures(_marked(one.panels, marks, None))] if one.panels else blocks))
    return found


def _stations(recording: Recording, figures: Drawn, marks: list[dict[str, Any]]) -> list[Section]:
    plan = recording.plan
    return [
        Section(
            f"Station {number}: {one.name}", [Figures(_marked(station_panels(figures, number, one, plan.test), marks, number))]
        )
        for number, one in enumerate(plan.stations, start=1)
    ]


def _structure(recording: Recording, figures: Drawn, marks: list[dict[str, Any]]) -> list[Section]:
    named = [(one.key, f"Floor {one.number}") for one in recording.channels if one.role == "x_floor"]
    title = "Floor displacements relative to the ground"
    parts = [named[first : first + 4] for first in range(0, len(named), 4)]
    panels = [figures.against_time(title, "Displacement", part, wide=True) for part in parts]
    if not panels:
        return []
    decay = _decay(recording)
    blocks: list[Block] = [Facts(decay)] if decay else []
    return [Section("Structure", [*blocks, Figures(_marked(panels, marks, None))])]


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


def _plan(recording: Recording) -> list[Block]:
    """The test plan: a heading and tables for each of its parts."""
    found: list[Block] = []
    for title, part in _parts(recording):
        found += [Heading(title), Tables([table for one in part for table in _tables(one)])]
    return found


def _parts(recording: Recording) -> list[tuple[str, list[Group]]]:
    plan = recording.plan
    found = []
    if plan.test == "client":
        found.append(("Client", groups("Client", plan.client)))
    elif plan.driven:
        found.append(("Drive", groups("Drive", plan.drive)))
    if plan.motion.kind != "none":
        found.append(("Ground motion", groups(type(plan.motion).title, plan.motion)))
    found += [(f"Force on floor {force.floor}", groups("Force", force)) for force in plan.forces]
    if not plan.start.at_rest:
        found.append(("Start", groups("Start", plan.start)))
    if plan.structure.kind != "none":
        found.append(("Structure", groups(type(plan.structure).title, plan.structure)))
    moved = ("motion", "forces", "start", "drive", "client", "structure", "stations", "couplings")
    found.append(("Test", groups("Time and pace", plan, plan.test, leave_out=moved)))
    for number, station in enumerate(plan.stations, start=1):
        found.append((f"Station {number}: {station.name}", groups("Station", station, plan.test)))
    for coupling in plan.couplings:
        laws = [group for k, law in enumerate(coupling.specimens, start=1) for group in groups(f"Specimen {k}", law)]
        shared = groups(coupling.title, coupling, leave_out=("specimens",))
        found.append((f"Shared specimen: {coupling.name}", [*shared, *laws]))
    return found


def _tables(group: Group) -> list[Table]:
    heads = [Head("Quantity", share=2.2), Head("Value", True, 1.6), Head("Unit", share=0.9)]
    rows = (
        [Table(group.title, heads, [[row.label, row.value, row.unit] for row in group.rows], whole=False)] if group.rows else []
    )
    return [*rows, *(_grid(one) for one in group.grids)]


def _grid(grid: Grid) -> Table:
    heads = [Head("No.", share=0.5), *(Head(one, True) for one in grid.columns)]
    rows = [[str(number), *row] for number, row in enumerate(grid.rows, start=1)]
    return Table(grid.title, heads, rows, whole=len(grid.columns) > 4)


def repeating(recording: Recording) -> str:
    """What a run of the same plan repeats."""
    if recording.plan.test == "client":
        return OF_CLIENT
    return OF_RIGS if external(recording.plan) else SAME


def _repeat(run: Mapping[str, Any], recording: Recording) -> list[Block]:
    return [Text([repeating(recording)]), Facts(_origin(run, recording), long=True)]


def _origin(run: Mapping[str, Any], recording: Recording) -> list[tuple[str, str]]:
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
