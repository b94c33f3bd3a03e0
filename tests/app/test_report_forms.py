"""Light HTML, PDF and SVG of reports: small, self-contained, and with everything that the report says."""

from __future__ import annotations

import re
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from app.reports import html
from app.reports import pdf as pdf_module
from app.reports.document import Document, Letterhead
from app.reports.figures import Panel
from app.reports.glyphs import BOX, SAID, boxed, lacking
from app.reports.of_run import Annotation, Surroundings, document
from app.reports.packed import packed
from app.reports.pdf import pdf
from app.reports.svg.frame import Size
from app.reports.svg.palette import paper
from app.reports.svg.path import path, thinned
from app.reports.svg.plot import plot
from app.reports.svg.scale import linear, logarithmic
from tests.app.test_laboratory import SVG, png
from tests.app.test_reports import RUN, Page, recorded, shortened

NOTES = (
    Annotation(5.79, None, 2, "Compensator saturates", "Ana Ruiz", "2026-11-23T09:30:00Z"),
    Annotation(6.0, 7.5, None, "<b>Oil</b> supply is loud", "B. Chen", "2026-11-23T09:31:00Z"),
)
AROUND = Surroundings(Letterhead("Structures Laboratory", "12 Harbour Road", (SVG, "image/svg+xml")), ("Approved by",), NOTES)


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Document:
    return document(RUN, recorded(tmp_path_factory.mktemp("forms"), shortened("table3-04")), None, AROUND)


@pytest.fixture(scope="module")
def light(report: Document) -> Page:
    text = html.light(report)
    assert len(text.encode()) < 1e6 and "<script" not in text
    return Page(text)


def drawn(panel: Panel, **more: Any) -> ElementTree.Element:
    return ElementTree.fromstring(plot(panel, Size(530, 230), 1000, **more))


def lined(x: Any, y: Any, **spec: Any) -> Panel:
    trace = {"name": "one", "x": packed(np.asarray(x, dtype=float)), "y": packed(np.asarray(y, dtype=float)), "colour": 0}
    return Panel("A", "A line.", {"traces": [trace], "x": "Time, s", "y": "Force, kN", "from_zero": "", **spec})


def texts(drawing: ElementTree.Element) -> list[str]:
    return [one.text or "" for one in drawing.iter() if one.tag.endswith("text")]


def test_the_light_report_needs_nothing_outside_itself_and_names_every_figure(light: Page, report: Document) -> None:
    for tag, attrs in light.tags:
        for name in ("src", "href", "srcset", "action", "data"):
            assert (attrs.get(name) or "data:").startswith("data:"), (tag, attrs)
    figures = [attrs for tag, attrs in light.tags if tag == "svg"]
    assert len(figures) == len(report.panels) > 10
    assert all(attrs["role"] == "img" and len(attrs["aria-label"] or "") > 20 for attrs in figures)


def test_the_laboratory_heads_the_report_and_signatures_end_it(light: Page) -> None:
    text = light.text
    assert text.index("Structures Laboratory") < text.index("Completed") < text.index("Approved by")
    assert any(tag == "img" and (attrs["src"] or "").startswith("data:image/svg+xml") for tag, attrs in light.tags)


def test_annotations_are_listed_and_marked_on_the_charts_that_they_concern(light: Page, report: Document) -> None:
    assert "6.00 to 7.50 s" in light.text and "whole test" in light.text and "<b>Oil</b> supply is loud" in light.text
    marked = {panel.title: [one["text"] for one in panel.spec.get("marks", [])] for panel in report.panels}
    assert marked["Ground acceleration"] == ["1", "2"] and "Response spectrum, 5 % damping" in marked
    first, second = [one for one in report.sections if one.title.startswith("Station")]
    marks = [panel.spec.get("marks", []) for panel in first.blocks[0].panels if panel.spec["x"] == "Time, s"]  # type: ignore[union-attr]
    assert all([one["text"] for one in given] == ["2"] for given in marks)
    assert any(len(panel.spec.get("marks", [])) == 2 for panel in second.blocks[0].panels)  # type: ignore[union-attr]


def test_the_record_of_a_test_holds_limits_peaks_and_deviations(light: Page, tmp_path: Path) -> None:
    text = light.text
    assert "Controller rate 1024 Hz" in text and "Peak / bound" in text
    assert "Fields that differ from the template Field Template This test Unit Duration 40 8 s" in text
    plan = shortened("linear-damper")
    station = plan.stations[0]
    tight = station.model_copy(update={"limits": station.limits.model_copy(update={"displacement": 0.005})})
    tripped = recorded(tmp_path, plan.model_copy(update={"stations": (tight,)}))
    page = Page(html.light(document({**RUN, "attempt": 2}, tripped)))
    assert "of 8.01 s." in page.text and "This is attempt 2" in page.text
    assert "trip" in page.text.split("Measured force")[0]


def test_the_pdf_is_tagged_holds_the_title_and_is_small(report: Document) -> None:
    made = pdf(report)
    assert len(made) < 1e6 and is_tagged(made)


def test_text_of_people_is_never_markup_in_a_pdf(tmp_path: Path) -> None:
    name = '#panic() *bold* $x$ </text> \x07 \\ ] #image("/etc/passwd")'
    plan = shortened("linear-damper", name=name, duration=2.0)
    around = Surroundings(Letterhead(name, name, (png(), "image/png")), (name,), (Annotation(1.0, None, None, name, name, ""),))
    assert pdf(document(RUN, recorded(tmp_path, plan), None, around)).startswith(b"%PDF-")


def test_characters_without_a_font_are_boxes_in_a_pdf_which_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[str] = []
    typeset = pdf_module._typeset

    def watched(text: str, **more: bool) -> bytes:
        given.append(text)
        return typeset(text, **more)

    monkeypatch.setattr(pdf_module, "_typeset", watched)
    name = "试验 Test 😀 \U0010fffd"  # the last one is private: no font has it
    plan = shortened("linear-damper", name=name, notes=name, duration=2.0)
    plan = plan.model_copy(update={"stations": (plan.stations[0].model_copy(update={"name": name}),)})
    around = Surroundings(Letterhead(name), (name,), (Annotation(1.0, None, 1, name, name, ""),))
    run = {**RUN, "name": name, "submitted_by": name, "notes": name, "tags": [name]}
    made = document(run, recorded(tmp_path, plan), None, around)
    assert is_tagged(pdf(made))
    assert len(given) == 2 and SAID not in given[0] and SAID in given[1]
    assert "Test" in given[1] and BOX in given[1] and "\U0010fffd" not in given[1]
    assert html.light(made).count(name) > 8 and SAID not in html.light(made)
    assert lacking("a\U0010fffdéαΔ−²") == {"\U0010fffd"} and boxed("a\U0010fffdé", {"\U0010fffd"}) == f"a{BOX}é"


def test_a_logo_whose_text_has_no_font_does_not_keep_the_pdf_from_being_made(report: Document) -> None:
    logo = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><text y="9">\U0010fffd</text></svg>'
    assert pdf(replace(report, letterhead=Letterhead("L", "", (logo.encode(), "image/svg+xml")))).startswith(b"%PDF-")


def test_tags_of_a_run_are_among_its_facts(report: Document, tmp_path: Path) -> None:
    made = document({**RUN, "tags": ["pilot", "MR damper"]}, recorded(tmp_path, shortened("linear-damper"), steps=10))
    assert ("Tags", "pilot, MR damper") in made.facts
    assert "Tags" not in dict(report.facts)


def test_many_stations_stay_below_a_megabyte(tmp_path: Path) -> None:
    station = shortened("table3-04").stations[0]
    stations = tuple(station.model_copy(update={"name": f"S{j}", "dampers": 1}) for j in range(12))
    made = document(RUN, recorded(tmp_path, shortened("table3-04", stations=stations), steps=100))
    assert len(html.light(made).encode()) < 1e6


def test_a_line_with_a_gap_is_two_lines_and_a_lone_sample_is_a_dot() -> None:
    y = np.array([0.0, 1.0, np.nan, 2.0, np.nan, 3.0, 3.0])
    data = path(np.arange(7.0), y)
    assert data == "M0 0l10 10M30 20h0M50 30l10 0"
    assert path(np.array([np.nan]), np.array([1.0])) == ""


def test_thinning_keeps_spikes_and_the_shape_of_a_loop() -> None:
    x, y = np.arange(10_000.0), np.zeros(10_000)
    y[4321] = 5.0
    kept = thinned(x, y, 400)
    assert kept[1].max() == 5.0 and len(kept[0]) < 900
    angle = np.linspace(0, 40 * np.pi, 20_000)
    loop = thinned(np.cos(angle), np.sin(angle), 400)
    assert len(loop[0]) <= 4 * 750 + 2 and loop[0].min() == pytest.approx(-1, abs=1e-6)


@pytest.mark.parametrize(
    ("values", "labels", "power"),
    [
        ([0.0, 40.0], ["0", "10", "20", "30", "40"], ""),
        ([-0.004, 0.004], ["−0.004", "−0.002", "0.000", "0.002", "0.004"], ""),
        ([0.0, 3e6], ["0", "1", "2", "3"], "× 10⁶"),
        ([-2e-5, 0.0], ["−20", "−15", "−10", "−5", "0"], "× 10⁻⁶"),
        ([5.0, 5.0], ["4.6", "4.8", "5.0", "5.2", "5.4"], ""),
        ([], ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"], ""),
    ],
)
def test_ticks_are_round_and_labelled_alike(values: list[float], labels: list[str], power: str) -> None:
    scale = linear(np.array(values), 5, tight=True)
    assert ([label for _, label in scale.ticks], scale.power) == (labels, power)


def test_a_logarithmic_scale_has_powers_of_ten_and_leaves_out_what_has_none() -> None:
    scale = logarithmic(np.array([0.0, np.nan, 0.01, 1.0, 100.0]), 6)
    assert [label for _, label in scale.ticks] == ["10⁻²", "10⁻¹", "10⁰", "10¹", "10²"]
    places = scale.place(np.array([0.01, 0.0, 100.0]))
    assert places[0] == 0 and np.isnan(places[1]) and places[2] == 1
    assert len(logarithmic(np.array([2.0, 3.0]), 4).ticks) >= 2


def test_a_figure_shows_axis_titles_ticks_marks_and_held_out_spans() -> None:
    marks = [
        {"from": 2.0, "to": None, "text": "1"},
        {"from": 5.0, "to": 7.0, "text": "2"},
        {"from": 99.0, "to": None, "text": "3"},
    ]
    spans = [{"from": 0.0, "to": 4.0, "text": "held out"}]
    drawing = drawn(lined(range(11), np.sin(range(11)), marks=marks, spans=spans))
    found = texts(drawing)
    assert {"Time, s", "Force, kN", "held out", "1", "2"} <= set(found) and "3" not in found
    assert len([one for one in drawing.iter() if one.get("class") == "span"]) == 1
    assert drawing.get("aria-label") == "A line."


def test_names_in_a_figure_are_text_and_a_drawing_for_paper_carries_its_colours() -> None:
    panel = Panel("A", "A.", {**lined([0, 1], [0, 1]).spec, "y": "</text><script>"})
    assert "</text><script>" in texts(drawn(panel))
    style = next(one.text for one in drawn(panel, style=paper("Libertinus Serif")) if one.tag.endswith("style"))
    assert style and ".l0{stroke:#0072b2}" in style


@pytest.mark.parametrize("y", [[], [np.nan, np.nan], [1.0], [0.0, 0.0]])
def test_a_figure_without_a_shape_is_still_drawn(y: list[float]) -> None:
    assert "Time, s" in texts(drawn(lined(range(len(y)), y)))


def test_bars_of_errors_stand_beside_each_other_and_begin_at_zero() -> None:
    traces = [
        {"name": name, "x": packed(np.array([1.0, 2.0])), "y": packed(np.array([3.0, np.nan])), "colour": place, "bars": True}
        for place, name in enumerate(("before", "after"))
    ]
    panel = Panel("Error", "Errors.", {"traces": traces, "x": "Time, s", "y": "Error, %", "from_zero": ""})
    bars = [one for one in drawn(panel).iter() if (one.get("class") or "").startswith("bar")]
    assert [one.get("d", "").count("M") for one in bars] == [1, 1]
    assert {"before", "after"} <= set(texts(drawn(panel)))


def test_a_map_of_cells_shows_sign_and_share_and_leaves_empty_cells_out() -> None:
    surface = {
        "x": [0.0, 1.0],
        "y": [0.0, 1.0],
        "z": [[1.0, None], [-2.0, 2.0]],
        "limit": 2.0,
        "title": "Force, kN",
        "said": [],
    }
    spec = {"surface": surface, "traces": [], "x": "Displacement, mm", "y": "Velocity, mm/s", "from_zero": ""}
    found = [one for one in drawn(Panel("Map", "A map.", spec)).iter() if one.get("class") in ("sp", "sn")]
    shades = [(one.get("class"), one.get("fill-opacity")) for one in found[:3]]
    assert shades == [("sp", "0.50"), ("sn", "1.00"), ("sp", "1.00")]


def is_tagged(made: bytes) -> bool:
    """Whether a PDF says that it keeps PDF/UA."""
    streams = b"".join(_inflated(one) for one in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", made, re.DOTALL))
    return made.startswith(b"%PDF-") and b"/MarkInfo" in made + streams and b"pdfuaid" in made + streams


def _inflated(data: bytes) -> bytes:
    try:
        return zlib.decompress(data)
    except zlib.error:
        return data
