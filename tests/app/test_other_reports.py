"""Reports of comparisons and sweeps: what they say, as HTML below 1 MB and as PDF."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from app.reports import html, of_comparison, of_sweep
from app.reports.document import Document, Letterhead
from app.reports.of_comparison import Curve
from app.reports.pdf import pdf
from tests.app.test_reports import Page

HEAD = Letterhead("Structures Laboratory")


def column(key: str, label: str, role: str, **more: Any) -> dict[str, Any]:
    return {"key": key, "label": label, "shown_label": "mm", "role": role, "categories": [], **more}


COLUMNS = [
    column("a", "Delay", "input"),
    column("b", "Damping", "input", shown_label="%"),
    column("mte", "MTE", "measure"),
    column("status", "Status", "outcome", categories=["completed", "tripped"]),
]
SWEEP: dict[str, Any] = {
    "id": "5", "number": 3, "name": "Delay and damping", "method": "grid", "state": "completed", "points": 9, "done": 9,
    "completed": 8, "tripped": 1, "invalid": 0, "failed": 0, "submitted_by": "Ana", "code_version": "1", "notes": ["A note."],
    "axes": [{"label": "Delay", "planned": 2.0, "lowest": 1, "highest": 3, "shown_label": "ms", "fields": ["stations.0.x"]}],
}  # fmt: skip


def values(count: int = 9) -> dict[str, list[Any]]:
    a, b = np.repeat([1.0, 2.0, 3.0], 3)[:count], np.tile([1.0, 2.0, 5.0], 3)[:count]
    mte: list[Any] = (10 * a + b).tolist()
    if count > 1:
        mte[1] = None  # a point without value
    return {"point": [*range(1, count + 1)], "a": a.tolist(), "b": b.tolist(), "mte": mte, "status": ["completed"] * count}


def both(document: Document) -> str:
    """The text of a report after both forms were made."""
    text = html.light(document)
    assert len(text.encode()) < 1e6 and pdf(document).startswith(b"%PDF-")
    return Page(text).text


def test_the_report_of_a_sweep_shows_spread_ends_map_and_the_influence_of_each_input() -> None:
    found = values()
    assert of_sweep.preferred(COLUMNS, found) == "mte"
    made = of_sweep.document(SWEEP, COLUMNS, found, "mte", HEAD, ("Director",))
    text = both(made)
    assert "9 of 9 points have results: 8 completed, 1 tripped." in text and "A note." in text
    assert [panel.title for panel in made.panels] == [
        "MTE over Delay and Damping", "Mean MTE at the lowest and the highest third of each input"
    ]  # fmt: skip
    tornado = made.panels[1].spec["tornado"]["rows"]
    assert [row["name"] for row in tornado] == ["Delay", "Damping"]  # the most influential first
    assert made.panels[0].spec["surface"]["z"][1][0] is None
    assert "lowest third" in text and "35" in text


def test_a_sweep_of_one_field_is_a_line_and_one_without_results_says_so() -> None:
    one = of_sweep.document(SWEEP, [COLUMNS[0], COLUMNS[2]], values(), "mte", HEAD, ())
    assert [panel.title for panel in one.panels] == ["MTE against Delay"]
    nothing: dict[str, list[Any]] = {key: [] for key in values()}
    assert of_sweep.preferred(COLUMNS, nothing) == ""
    assert "No point has results yet." in both(of_sweep.document({**SWEEP, "done": 0}, COLUMNS, nothing, "", HEAD, ()))


@pytest.mark.parametrize("count", [2, 20])
def test_the_report_of_a_comparison_shows_fields_measures_and_overlaid_signals(count: int) -> None:
    items = [
        {"ref": f"run:{k}", "label": f"Run {k}", "name": "Frame", "state": "completed", "rate_hz": 1024.0, "duration_s": 2.0}
        for k in range(count)
    ]
    difference = {"absolute": 1.0, "percent": -50.0}
    found = {
        "items": items, "reference": 0, "notes": [{"sentence": "The excitations differ."}],
        "fields": [{"within": "Station 1", "label": "Gain", "unit": "1/mm", "texts": [str(k) for k in range(count)]}],
        "measures": [
            {"where": "Station 1", "label": "MTE", "unit": "mm", "values": [2.0, *[1.0] * (count - 1)],
             "differences": [None, *[difference] * (count - 1)]}
        ],
    }  # fmt: skip
    time = np.arange(100) / 50
    roles = [("x_meas", False), ("x_meas", True), ("f_meas", True), ("x_floor", False)]
    curves = [Curve(k, role, loop, time, np.sin(time + k)) for k in range(count) for role, loop in roles]
    made = of_comparison.document(found, curves, HEAD, ("Director",), 1, 2)
    text = both(made)
    assert "1 field of the plans differs." in text and "The excitations differ." in text and "(−50 %)" in text
    titles = [panel.title for panel in made.panels]
    assert titles == [
        "Measured displacement, station 1",
        "Floor displacement, floor 2",
        "Force against displacement, station 1",
    ]
    assert len(made.panels[0].spec["traces"]) == min(count, 8)
    assert ("first 8 of 20 items" in text) == (count == 20)
