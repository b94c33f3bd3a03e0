"""The test record: who tested what, on which rig, with which software, within which limits, and what departed from the plan."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Any

import numpy as np

from app.reports.document import Block, Facts, Head, Table, Text
from app.shown import KINDS
from rths_engine.foundation import units
from rths_engine.planning import templates
from rths_engine.planning.connections import sentences
from rths_engine.planning.differences import differences
from rths_engine.planning.plan import Plan, RealTime, Station
from rths_engine.planning.safety import LIMITS
from rths_engine.recordings.run_file import Recording
from rths_engine.results.channels import key

NOT_DECISIVE = ("name", "notes", "template", "known", "pace")
MOST_CHANGES = 30  # fields that differ from the template; more are counted
SHORTER = 0.999  # of the planned duration


def record(run: Mapping[str, Any], recording: Recording) -> list[Block]:
    """Facts of the test, limits beside the peaks that were reached, and departures from plan and template."""
    plan = recording.plan
    rows = [
        ("Kind of test", KINDS[plan.test]),
        ("Tested by", run.get("submitted_by") or "–"),
        ("Rig", _rig(run, plan)),
        ("External stations", " ".join(sentences(plan))),
        ("Started", clock(run.get("started_at"))),
        ("Ended", clock(run.get("finished_at"))),
        ("Controller rate", f"{plan.controller_rate:g} Hz"),
        ("Integration", _integration(plan)),
        ("Pace", f"real time × {plan.pace.factor:g}" if isinstance(plan.pace, RealTime) else "as fast as possible"),
        ("Trip", (recording.summary["trip"] or {}).get("sentence", "none")),
        ("Engine version", str(recording.attrs.get("code_version", run.get("code_version", "–")))),
    ]
    limits = [_limits(recording)] if plan.stations else []
    return [Facts([(name, text) for name, text in rows if text], long=True), *limits, *_departures(run, recording)]


def clock(moment: str | None) -> str:
    """Date and time in UTC; a dash where there is none."""
    if not moment:
        return "–"
    return datetime.fromisoformat(moment).strftime("%Y-%m-%d %H:%M:%S UTC")


def _rig(run: Mapping[str, Any], plan: Plan) -> str:
    named = run.get("rig")
    shared = [f"{one.name} on stations {', '.join(map(str, one.stations))}" for one in plan.couplings]
    parts = "; ".join(dict.fromkeys([*map(_equipment, plan.stations), *shared]))
    return f"{named} ({parts})" if named and parts else str(named or parts)


def _equipment(station: Station) -> str:
    actuator = type(station.actuator).title
    return actuator if station.specimen.kind == "none" else f"{actuator} with {type(station.specimen).title}"


def _integration(plan: Plan) -> str:
    if plan.driven:
        return ""
    return f"{type(plan.integrator).title}, step {plan.integrator.dt * 1e3:.4g} ms"


def _limits(recording: Recording) -> Table:
    rows = []
    for number, station in enumerate(recording.plan.stations, start=1):
        for name, (words, _, shown) in LIMITS.items():
            bound = getattr(station.limits, name)
            if name == "oscillation":
                reached, share, said = "–", "–", f"{bound}"
                if bound == 0:  # no limit
                    continue
            else:
                peak = _peak(recording, number, name)
                reached = "–" if peak is None else _number(units.from_si(peak, shown), shown)
                share = "–" if peak is None else f"{100 * peak / bound:.0f} %"
                said = _number(units.from_si(bound, shown), shown)
            rows.append([f"{number} · {station.name}", words[0].upper() + words[1:], said, reached, share])
    heads = [
        Head("Station", share=1.5),
        Head("Limit", share=2.0),
        *(Head(one, True) for one in ("Bound", "Peak", "Peak / bound")),
    ]
    return Table("Safety limits and the peaks that were reached", heads, rows)


def _number(value: float, unit: str) -> str:
    return f"{value:.4g} {units.pretty(unit)}"


def _peak(recording: Recording, number: int, limit: str) -> float | None:
    """Largest magnitude (SI) of what a limit bounds; None before the first sample."""
    role = "f_meas" if limit == "force" else "x_cmd"
    values = np.nan_to_num(recording.signal(key(role, number)))
    if len(values) < 2:
        return None
    if limit == "velocity":
        values = np.diff(values) / recording.dt
    return float(np.max(np.abs(values)))


def _departures(run: Mapping[str, Any], recording: Recording) -> list[Block]:
    """What departed from the plan while the test ran, and from the template before it."""
    plan, simulated, whole = recording.plan, recording.summary["simulated_s"], recording.total * recording.dt
    said = []
    if simulated < SHORTER * whole:
        said.append(f"The test ended after {simulated:.2f} s of {whole:.2f} s.")
    if recording.status == "cancelled":
        said.append(str(run.get("reason") or "The test was stopped."))
    if int(run.get("attempt") or 1) > 1:
        said.append(f"This is attempt {run['attempt']}: the worker of an earlier attempt was lost.")
    client = recording.summary.get("client") or {}
    if waits := client.get("waits"):
        began = "1 ramp began late, by" if waits == 1 else f"{waits} ramps began late, the longest by"
        said.append(f"{began} {client['longest_wait_s'] * 1e3:.3g} ms: the client had not sent its displacement.")
    physics = [_physics(number, station) for number, station in enumerate(plan.stations, start=1)]
    said += [one for one in physics if one]
    changed = _changed(plan)
    if changed:
        said.append(f"{changed[0]} from the template {plan.template}.")
    blocks: list[Block] = [Text(["Deviations: " + (" ".join(said) or "none that the control room recorded.")])]
    return [*blocks, changed[1]] if changed else blocks


def _physics(number: int, station: Station) -> str:
    effects = [*station.actuator_physics, *station.specimen_physics, *station.sensor_physics]
    names = ", ".join(type(one).title for one in effects)
    return f"Station {number} has left-out physics: {names}." if names else ""


def _changed(plan: Plan) -> tuple[str, Table] | None:
    """The fields in which a plan differs from its template; None where there are none, or no such template."""
    known = {one for one in templates.names()}
    if plan.template not in known:
        return None
    found = differences([templates.template(plan.template).as_dict(), plan.as_dict()], NOT_DECISIVE)
    if not found:
        return None
    rows = [[one.title, one.texts[0], one.texts[1], one.unit] for one in found[:MOST_CHANGES]]
    heads = [Head("Field", share=3.0), Head("Template", True), Head("This test", True), Head("Unit")]
    count = f"{len(found)} field{' differs' if len(found) == 1 else 's differ'}"
    caption = "Fields that differ from the template"
    return count, Table(caption if len(found) <= MOST_CHANGES else f"{caption}, the first {MOST_CHANGES}", heads, rows)
