"""The report of a comparison of runs and recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.reports.digits import short
from app.reports.document import Block, Document, Figures, Head, Letterhead, Section, Signatures, Table, Text, Verdict
from app.reports.figures import Panel
from app.reports.made import made
from app.reports.packed import Samples, packed
from rths_engine.foundation import units
from rths_engine.results.channels import CHANNELS

AT_ONCE = 4  # items in one table
DRAWN = 8  # items in a figure; more lines cannot be told apart
COLOURS = 4
OVER_TIME = ("x_meas", "error", "f_meas", "ti", "d_alpha", "x_floor")


@dataclass(frozen=True, slots=True)
class Curve:
    """A signal of an item in shown units: over time, or (`loop`) sampled for a plot of one signal against another."""

    item: int
    role: str
    loop: bool
    time: Samples
    values: Samples


def document(
    found: Mapping[str, Any],
    curves: Sequence[Curve],
    letterhead: Letterhead,
    signatures: Sequence[str],
    station: int,
    floor: int,
) -> Document:
    """The report of a comparison, a ComparisonOut as JSON, with its curves of a station and a floor."""
    items = found["items"]
    count = len(found["fields"])
    fields = f"{count} field{'' if count == 1 else 's'} of the plans differ{'s' if count == 1 else ''}."
    sections = [
        Section("What is compared", [_items(items, found["reference"])]),
        Section("Fields of the plans that differ", _fields(found) or [Text(["No field of the plans differs."])]),
        Section("Measures", _measures(found)),
        Section("Signals", _signals(items, curves, station, floor)),
    ]
    if signatures:
        sections.append(Section("Signatures", [Signatures(signatures)], together=True))
    return Document(
        kind=f"Comparison of {len(items)} recordings",
        title=" and ".join(one["label"] for one in items) if len(items) < 4 else f"{items[0]['label']} to {items[-1]['label']}",
        verdict=Verdict(fields),
        facts=[("Reference", _named(items[found["reference"]]))],
        sections=sections,
        subject=f"Comparison with {items[found['reference']]['label']}",
        made=made(),
        further=[one["sentence"] for one in found["notes"]],
        letterhead=letterhead,
    )


def _named(item: Mapping[str, Any]) -> str:
    return f"{item['label']}: {item['name']}"


def _items(items: Sequence[Mapping[str, Any]], reference: int) -> Table:
    rows = []
    for number, one in enumerate(items):
        said = f"{one['label']} (reference)" if number == reference else one["label"]
        end = one["state"] or "imported"
        rows.append([said, one["name"], end, f"{one['rate_hz']:.5g} Hz", f"{one['duration_s']:.2f} s"])
    heads = [
        Head("Item", share=1.4),
        Head("Name", share=3),
        Head("Status"),
        Head("Sampling rate", True),
        Head("Duration", True),
    ]
    return Table("Runs and recordings", heads, rows)


def _fields(found: Mapping[str, Any]) -> list[Block]:
    items = found["items"]
    tables: list[Block] = []
    for first in range(0, len(items), AT_ONCE) if found["fields"] else []:
        part = range(first, min(len(items), first + AT_ONCE))
        heads = [Head("Field", share=2.4), *(Head(items[k]["label"], True, 1.2) for k in part), Head("Unit")]
        rows = []
        for one in found["fields"]:
            label = f"{one['within']}: {one['label']}" if one["within"] else one["label"]
            rows.append([label, *(one["texts"][k] or "–" for k in part), one["unit"]])
        tables.append(Table("Values in each plan", heads, rows))
    return tables


def _measures(found: Mapping[str, Any]) -> list[Block]:
    items, reference = found["items"], found["reference"]
    tables: list[Block] = []
    for first in range(0, len(items), AT_ONCE):
        part = range(first, min(len(items), first + AT_ONCE))
        heads = [Head("Measure", share=2.2), *(Head(items[k]["label"], True, 1.2) for k in part)]
        rows = []
        for one in found["measures"]:
            unit = f", {one['unit']}" if one["unit"] else ""
            cells = [_cell(one["values"][k], None if k == reference else one["differences"][k]) for k in part]
            rows.append([f"{one['where']}: {one['label']}{unit}", *cells])
        tables.append(Table("Measures, with the difference from the reference in brackets", heads, rows))
    return tables


def _cell(value: float | None, difference: Mapping[str, Any] | None) -> str:
    if value is None:
        return "–"
    text = short(value, 3)
    if difference and difference["percent"] is not None:
        text += f" ({difference['percent']:+.3g} %)"
    return text.replace("-", "−")


def _signals(items: Sequence[Mapping[str, Any]], curves: Sequence[Curve], station: int, floor: int) -> list[Block]:
    shown = items[:DRAWN]
    blocks: list[Block] = []
    if len(items) > DRAWN:
        blocks.append(Text([f"The figures show the first {DRAWN} of {len(items)} items."], "note"))
    panels = []
    for role in OVER_TIME:
        own = [one for one in curves if one.role == role and not one.loop and one.item < DRAWN and len(one.values)]
        if own:
            of = f"floor {floor}" if CHANNELS[role].counts == "floor" else f"station {station}"
            panels.append(_over_time(f"{CHANNELS[role].label}, {of}", role, own, shown))
    loops = [one for one in curves if one.loop and one.item < DRAWN]
    loop = _loop(station, loops, shown)
    panels += [loop] if loop else []
    return [*blocks, Figures(panels)] if panels else [*blocks, Text(["The items have no signal in common."])]


def _trace(number: int, items: Sequence[Mapping[str, Any]], x: Samples, y: Samples) -> dict[str, Any]:
    look = {"colour": number % COLOURS, "dash": number >= COLOURS}
    return {"name": items[number]["label"], "x": packed(x), "y": packed(y), **look}


def _over_time(title: str, role: str, own: Sequence[Curve], items: Sequence[Mapping[str, Any]]) -> Panel:
    unit = units.pretty(CHANNELS[role].shown)
    traces = [_trace(one.item, items, one.time, one.values) for one in own]
    axis = f"{CHANNELS[role].label}, {unit}" if unit not in ("", "1") else CHANNELS[role].label
    names = ", ".join(items[one.item]["label"] for one in own)
    spec = {"traces": traces, "x": "Time, s", "y": axis, "from_zero": ""}
    return Panel(title, f"{title} of {names} over time.", spec, wide=True)


def _loop(station: int, loops: Sequence[Curve], items: Sequence[Mapping[str, Any]]) -> Panel | None:
    pairs = {(one.item, one.role): one.values for one in loops}
    traces = []
    for number in range(len(items)):
        x, y = pairs.get((number, "x_meas")), pairs.get((number, "f_meas"))
        if x is not None and y is not None and len(x) == len(y):
            traces.append({**_trace(number, items, x, y), "thin": True})
    if not traces:
        return None
    title = f"Force against displacement, station {station}"
    spec = {"traces": traces, "x": "Measured displacement, mm", "y": "Measured force, kN", "from_zero": ""}
    return Panel(title, f"{title} of {', '.join(one['name'] for one in traces)}.", spec, wide=True, tall=True)
