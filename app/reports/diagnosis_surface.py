"""The plot of an unexplained force over displacement and velocity."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from app.reports.diagnosis_names import capital
from app.reports.digits import short
from app.reports.figures import Panel
from rths_engine.diagnosis.schema.pictures import Cells, Surface


def surface_panel(surface: Surface) -> Panel:
    """The mean of the unexplained force in cells of displacement and velocity, with standard error and counts on hover."""
    x, v, output = surface.displacement, surface.velocity, surface.output
    columns = list(zip(*surface.mean, strict=True))  # a row for each velocity
    z = [[None if value is None else value / output.factor for value in row] for row in columns]
    known = [(abs(value), value) for row in z for value in row if value is not None]
    limit = max((size for size, _ in known), default=0.0) or 1.0
    at = f", {surface.place}" if surface.place else ""
    title = f"{capital(output.label)} over displacement and velocity{at}"
    spec: dict[str, Any] = {
        "surface": {
            "x": _middles(x),
            "y": _middles(v),
            "z": z,
            "said": [[_cell(surface, row, column) for row in range(len(surface.mean))] for column in range(len(columns))],
            "limit": limit,
            "title": f"{capital(output.label)}, {output.shown}",
        },
        "traces": [],
        "x": f"{capital(x.label)}, {x.shown}",
        "y": f"{capital(v.label)}, {v.shown}",
        "from_zero": "",
    }
    largest = max(known, default=(0.0, 0.0))[1]
    cells = f"{len(known)} of {len(columns) * len(surface.mean)} cells hold samples"
    said = f"the largest mean is {short(largest, 3)} {output.shown}; {cells}"
    return Panel(title, f"{title}: {said}.", spec, wide=True, tall=True)


def _middles(cells: Cells) -> list[float]:
    edges = [edge for edge in cells.edges if edge is not None]
    return [0.5 * (low + high) / cells.factor for low, high in pairwise(edges)]


def _cell(surface: Surface, row: int, column: int) -> str:
    """The hover text of a cell."""
    x, v, output = surface.displacement, surface.velocity, surface.output
    place = f"{short(_middles(x)[row], 3)} {x.shown}, {short(_middles(v)[column], 3)} {v.shown}"
    mean, error = surface.mean[row][column], surface.error[row][column]
    if mean is None:
        return f"{place}: no sample"
    doubt = "" if error is None else f" ± {short(error / output.factor, 2)}"
    counts = f"{surface.samples[row][column]} samples, {surface.visits[row][column]} visits"
    return f"{place}: {short(mean / output.factor, 3)}{doubt} {output.shown} ({counts})"
