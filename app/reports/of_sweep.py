"""The report of a sweep: its fields, the spread of each result, the best and worst points, and the influence of each input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from app.reports.digits import short
from app.reports.document import Block, Document, Figures, Head, Letterhead, Section, Signatures, Table, Text, Verdict
from app.reports.figures import Panel
from app.reports.made import made
from app.reports.packed import Samples, packed

ENDS = 5  # points with the smallest and with the largest value
MOST_RESULTS = 40  # rows of the table of results
MOST_CELLS = 40  # of a heat map on each side
LEAST = 3  # points from which an influence is computed
Column = Mapping[str, Any]


def document(
    sweep: Mapping[str, Any],
    columns: Sequence[Column],
    values: Mapping[str, Sequence[Any]],
    chosen: str,
    letterhead: Letterhead,
    signatures: Sequence[str],
) -> Document:
    """The report of a sweep (a SweepDetail as JSON) with its results in columns. `chosen` is the key of the result shown."""
    numbers = [one for one in columns if one["role"] in ("input", "intensity") and not one["categories"]]
    inputs = [one for one in numbers if len(np.unique(_known(one, values))) > 1]
    result = next((one for one in columns if one["key"] == chosen), None)
    sections = [Section("Fields that vary", [_axes(sweep)]), Section("Results of all points", [_results(columns, values)])]
    if result:
        sections += [
            Section(f"Smallest and largest: {_name(result)}", [_ends(result, inputs, values)]),
            Section(f"Influence of the inputs on: {_name(result)}", _influence(result, inputs, values)),
        ]
    if signatures:
        sections.append(Section("Signatures", [Signatures(signatures)], together=True))
    done, points = sweep["done"], sweep["points"]
    counts = ", ".join(f"{sweep[one]} {one}" for one in ("completed", "tripped", "invalid", "failed") if sweep[one])
    return Document(
        kind="Sweep of a test plan",
        title=sweep["name"],
        verdict=Verdict(f" of {points} points have results: {counts or 'none'}.", str(done), "good" if done == points else ""),
        facts=[
            ("Sweep", str(sweep["number"])),
            ("Method", sweep["method"].replace("_", " ")),
            ("Submitted by", sweep["submitted_by"] or "–"),
            ("Status", str(sweep["state"])),
            ("Engine version", sweep["code_version"]),
            ("Identifier", sweep["id"]),
        ],
        sections=sections,
        subject=f"Sweep {sweep['number']}",
        made=made(),
        further=sweep["notes"],
        letterhead=letterhead,
    )


def preferred(columns: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> str:
    """The key of the first measure that differs between points; empty where there is none."""
    for one in columns:
        known = _known(one, values)
        if one["role"] == "measure" and len(known) and np.ptp(known) > 0:
            return str(one["key"])
    return ""


def _known(column: Column, values: Mapping[str, Sequence[Any]]) -> Samples:
    numbers = _numbers(column, values)
    return numbers[np.isfinite(numbers)]


def _numbers(column: Column, values: Mapping[str, Sequence[Any]]) -> Samples:
    if column["categories"]:
        return np.full(len(values[column["key"]]), np.nan)
    return np.array([np.nan if one is None else one for one in values[column["key"]]], dtype=float)


def _name(column: Column) -> str:
    return f"{column['label']}, {column['shown_label']}" if column["shown_label"] else str(column["label"])


def _axes(sweep: Mapping[str, Any]) -> Table:
    rows = []
    for one in sweep["axes"]:
        ends = [_said(one["lowest"]), _said(one["highest"])]
        rows.append([one["label"], _said(one["planned"]), *ends, one["shown_label"], ", ".join(one["fields"][:3])])
    heads = [
        Head("Field", share=2.2),
        *(Head(one, True) for one in ("Plan", "Lowest", "Highest")),
        Head("Unit"),
        Head("Path", share=2.6),
    ]
    return Table("Each field with the value of the plan itself", heads, rows)


def _said(value: Any) -> str:
    return "–" if value is None else value if isinstance(value, str) else short(value, 3)


def _results(columns: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> Block:
    rows = []
    for one in columns:
        known = _known(one, values)
        if one["role"] in ("measure", "outcome") and len(known):
            marks = np.quantile(known, [0.0, 0.16, 0.5, 0.84, 1.0])
            rows.append([_name(one), *(short(mark, 3) for mark in marks.tolist()), str(len(known))])
    if not rows:
        return Text(["No point has results yet."])
    heads = [Head("Result", share=3), *(Head(one, True) for one in ("Smallest", "16 %", "Median", "84 %", "Largest", "Points"))]
    caption = "Spread over the points" + (f", the first {MOST_RESULTS} results" if len(rows) > MOST_RESULTS else "")
    return Table(caption, heads, rows[:MOST_RESULTS])


def _ends(result: Column, inputs: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> Table:
    numbers = _numbers(result, values)
    order = [one for one in np.argsort(numbers, kind="stable").tolist() if np.isfinite(numbers[one])]
    picked = [*order[:ENDS], *order[max(ENDS, len(order) - ENDS) :]]
    rows = [
        [
            str(values["point"][one]),
            short(float(numbers[one]), 3),
            *(_said(values[column["key"]][one]) for column in inputs[:5]),
        ]
        for one in picked
    ]
    heads = [Head("Point", share=0.7), Head(_name(result), True, 1.5), *(Head(_name(one), True, 1.3) for one in inputs[:5])]
    return Table(f"The {ENDS} points with the smallest and with the largest value", heads, rows)


def _influence(result: Column, inputs: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> list[Block]:
    if not inputs:
        return [Text(["No numerical input varies."])]
    panels = [_map(result, inputs, values), _tornado(result, inputs, values)]
    if len(inputs) == 1:
        panels = [_line(result, inputs[0], values)]
    return [Figures([one for one in panels if one])]


def _line(result: Column, one: Column, values: Mapping[str, Sequence[Any]]) -> Panel:
    x, y = _numbers(one, values), _numbers(result, values)
    order = np.argsort(x, kind="stable")
    trace = {"name": _name(result), "x": packed(x[order]), "y": packed(y[order]), "colour": 0}
    spec = {"traces": [trace], "x": _name(one), "y": _name(result), "from_zero": ""}
    return Panel(f"{result['label']} against {one['label']}", f"{_name(result)} against {_name(one)}.", spec, wide=True)


def _map(result: Column, varied: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> Panel | None:
    """The mean of a result in cells of the first two inputs, where these form a grid."""
    if len(varied) < 2:
        return None
    x, y, z = (_numbers(one, values) for one in (*varied[:2], result))
    across, up = np.unique(x[np.isfinite(x)]), np.unique(y[np.isfinite(y)])
    if max(len(across), len(up)) > MOST_CELLS:
        return None
    cells: list[list[float | None]] = []
    for row in up:
        here = [z[(x == column) & (y == row) & np.isfinite(z)] for column in across]
        cells.append([float(one.mean()) if len(one) else None for one in here])
    known = [abs(one) for row in cells for one in row if one is not None]
    surface = {
        "x": across.tolist(),
        "y": up.tolist(),
        "z": cells,
        "limit": max(known, default=1.0) or 1.0,
        "title": _name(result),
    }
    spec = {
        "surface": {**surface, "said": [], "each": True},
        "traces": [],
        "x": _name(varied[0]),
        "y": _name(varied[1]),
        "from_zero": "",
    }
    title = f"{result['label']} over {varied[0]['label']} and {varied[1]['label']}"
    return Panel(title, f"{title}: largest magnitude {short(max(known, default=0.0), 3)}.", spec, wide=True, tall=True)


def _tornado(result: Column, varied: Sequence[Column], values: Mapping[str, Sequence[Any]]) -> Panel | None:
    """The mean result over the lowest and over the highest third of each input, the most influential input first."""
    y = _numbers(result, values)
    rows = []
    for one in varied:
        x = _numbers(one, values)
        both = np.isfinite(x) & np.isfinite(y)
        if both.sum() < LEAST:
            continue
        low, high = np.quantile(x[both], [1 / 3, 2 / 3])
        rows.append(
            {"name": one["label"], "low": float(y[both & (x <= low)].mean()), "high": float(y[both & (x >= high)].mean())}
        )
    if not rows:
        return None
    rows.sort(key=lambda row: -abs(float(row["high"]) - float(row["low"])))
    centre = float(y[np.isfinite(y)].mean())
    spec = {
        "tornado": {"rows": rows, "centre": centre},
        "traces": [],
        "x": _name(result),
        "y": "",
        "from_zero": "",
        "height": 90 + 34 * len(rows),
    }
    said = "; ".join(f"{row['name']} {short(float(row['low']), 3)} to {short(float(row['high']), 3)}" for row in rows)
    title = f"Mean {result['label']} at the lowest and the highest third of each input"
    return Panel(title, f"{title}: {said}.", spec, wide=True)
