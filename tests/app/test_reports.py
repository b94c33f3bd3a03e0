"""The report: complete, self-contained and light, for completed, tripped and cancelled tests."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.reports import html
from app.reports.document import Text
from app.reports.of_run import document, repeating
from app.reports.packed import packed
from app.reports.plan_tables import groups
from app.reports.published import published
from app.reports.record_of_test import record
from rths_engine.parts.ground_motions import Motion, MotionLibrary, spectral_acceleration
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.planning import templates
from rths_engine.planning.model import Model
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.paper import PAPER
from rths_engine.planning.plan import Plan, Station
from rths_engine.recordings import run_file as recordings
from rths_engine.recordings.run_file import Recording
from rths_engine.results.decimate import extremes
from rths_engine.running.run import Run

RUN: dict[str, Any] = {
    "id": "0b7c2a52-6a55-4b3e-b1a6-3f6f2a9d1c11",
    "number": 12,
    "submitted_by": "A. Student",
    "submitted_at": "2026-11-23T01:00:00Z",
    "started_at": "2026-11-23T01:00:01.250Z",
    "finished_at": None,
    "attempt": 1,
    "reason": "Stopped by A. Student at 1.00 s.",
    "recording": {"sha256": "ab" * 32, "size": 1},
}


def report_html(run: dict[str, Any], recording: Recording, motions: MotionLibrary | None = None) -> str:
    """The interactive report, whose plots carry their data."""
    return html.interactive(document(run, recording, motions))


def recorded(
    folder: Path, plan: Plan, status: str = "completed", steps: int | None = None, library: MotionLibrary | None = None
) -> Recording:
    run = Run(plan, library or MotionLibrary(None))
    run.advance(steps or run.total)
    recordings.save(folder / "run.h5", run.result("tripped" if run.trip else status, 0.5))
    return recordings.load(folder / "run.h5")


def shortened(template: str, **changes: Any) -> Plan:
    return templates.template(template).model_copy(update={"duration": 8.0, **changes})


@pytest.fixture(scope="module")
def fourth(tmp_path_factory: pytest.TempPathFactory) -> tuple[Recording, str]:
    recording = recorded(tmp_path_factory.mktemp("report"), templates.template("table3-04"))
    return recording, report_html(RUN, recording)


class Page(HTMLParser):
    """Tags, their text and the data of the plots."""

    def __init__(self, html: str):
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = [("", {})]
        self.texts: list[tuple[str, str]] = []
        self.specs: list[dict[str, Any]] = []
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        tag, attrs = self.tags[-1]
        if tag == "script" and attrs.get("type") == "application/json" and data.strip().startswith("{"):
            self.specs.append(json.loads(data))
        elif tag not in ("script", "style") and data.strip():
            self.texts.append((tag, " ".join(data.split())))

    @property
    def text(self) -> str:
        return " ".join(text for _, text in self.texts)


def unpacked(array: dict[str, str]) -> np.ndarray:
    return np.frombuffer(base64.b64decode(array["bdata"]), dtype="<f4")


def test_the_report_names_the_test_its_end_and_who_asked_for_it(fourth: tuple[Recording, str]) -> None:
    recording, html = fourth
    text = Page(html).text
    assert recording.plan.name in text
    assert "Completed : all 40.00 s were simulated; no safety limit was exceeded." in text
    for fact in (
        "A. Student",
        "2026-11-23 01:00:01 UTC",
        recording.plan.digest,
        "Seed of the sensor noise 4",
        RUN["id"],
        "ab" * 32,
    ):
        assert fact in text


def row_of(page: Page, heading: str) -> list[str]:
    """The cells of the first row with this heading, the meaning of the measure last."""
    cells = [text for tag, text in page.texts if tag in ("th", "td")]
    at = cells.index(heading)
    return cells[at : at + 7]


def test_the_measures_stand_beside_those_of_the_paper(fourth: tuple[Recording, str]) -> None:
    recording, html = fourth
    page = Page(html)
    assert row_of(page, "1 · Storey 1 damper")[:4] == [
        "1 · Storey 1 damper", "Chen and Ricles (2012)", "2 · Storey 2 damper", "Chen and Ricles (2012)"
    ]  # fmt: skip
    first, second = recording.summary["stations"]
    assert row_of(page, "MTE, mm")[1:6] == [
        f"{first['mte_mm']:.2f}", "0.8", f"{second['mte_mm']:.2f}", "1.6", "maximum tracking error"
    ]  # fmt: skip
    assert row_of(page, "MEE, kN·m")[2] == "−2.6"
    assert row_of(page, "Peak force, kN")[1:3] == [f"{first['peak_force_kN']:.1f}", "–"]
    assert f"{recording.summary['floors_peak_mm'][1]:.1f}" in row_of(page, "Floor peak, mm")


def test_the_further_measures_have_a_table_with_a_dash_where_there_is_none(tmp_path: Path) -> None:
    recording = recorded(tmp_path, shortened("two-storeys"))
    del recording.summary["stations"][0]["delay_ms"]  # as in a recording from before it was measured
    recording.summary["stations"][0]["energy_error_percent"] = None
    page, first = Page(report_html(RUN, recording)), recording.summary["stations"][0]
    assert row_of(page, "FEI delay, ms")[1] == f"{first['fei_delay_ms']:.2f}".replace("-0.00", "0.00")
    assert row_of(page, "FEI amplitude")[1] == f"{first['fei_amplitude']:.4f}"
    assert row_of(page, "Delay, ms")[1] == row_of(page, "HSEE, %")[1] == "–"
    assert f"Input energy, kN·m {recording.summary['input_energy_kNm']:.1f}" in page.text


def test_an_unstable_simulation_of_the_paper_is_called_so(tmp_path: Path) -> None:
    text = Page(report_html(RUN, recorded(tmp_path, templates.template("table3-01")))).text
    assert text.count("report this simulation as unstable: a limit stopped the test") == 1


def test_only_a_test_that_is_the_simulation_of_the_paper_has_its_row(fourth: tuple[Recording, str], tmp_path: Path) -> None:
    whole, _ = fourth
    plan = whole.plan
    assert isinstance(plan.motion, RecordMotion)
    record = MotionLibrary(None).get(plan.motion.record)
    queued = plan.model_copy(update={"name": "Ours", "motion": plan.motion.model_copy(update={"sha256": record.sha256})})
    assert published(whole) == published(replace(whole, plan=queued)) == PAPER["table3-04"]
    other = plan.model_copy(update={"motion": plan.motion.model_copy(update={"sha256": "0" * 64})})
    assert published(replace(whole, plan=other)) is published(replace(whole, status="cancelled")) is None
    for template in ("table3-01", "linear-damper"):
        text = Page(report_html(RUN, recorded(tmp_path, shortened(template)))).text
        assert "Chen and Ricles (2012)" not in text.split("Notes")[0], template


def test_a_tripped_test_says_station_limit_value_and_time(tmp_path: Path) -> None:
    plan = shortened("linear-damper")
    tight = plan.stations[0].limits.model_copy(update={"displacement": 0.005})
    station = plan.stations[0].model_copy(update={"limits": tight})
    recording = recorded(tmp_path, plan.model_copy(update={"stations": (station,)}))
    text = Page(report_html(RUN, recording)).text
    trip = recording.summary["trip"]
    assert f"Tripped at {trip['time_s']:.3f} s: command displacement of station 1 (Damper) was" in text
    assert "beyond its limit of 5 mm." in text


def test_a_cancelled_test_says_who_stopped_it(tmp_path: Path) -> None:
    text = Page(report_html(RUN, recorded(tmp_path, shortened("two-storeys"), "cancelled", steps=100))).text
    assert "Cancelled : Stopped by A. Student at 1.00 s." in text


def test_a_test_stopped_before_its_first_step_still_has_a_report(tmp_path: Path) -> None:
    run = Run(shortened("two-storeys"), MotionLibrary(None))
    recordings.save(tmp_path / "run.h5", run.result("cancelled", 0.0))
    text = Page(report_html(RUN, recordings.load(tmp_path / "run.h5"))).text
    assert "Cancelled" in text and "0.00 s of test" in text


def test_every_plot_of_figures_8_and_9_is_there_with_units_on_its_axes(fourth: tuple[Recording, str]) -> None:
    page = Page(fourth[1])
    axes = [(spec["x"], spec["y"]) for spec in page.specs]
    for wanted in (
        ("Time, s", "Displacement, mm"),
        ("Measured displacement, mm", "Measured force, kN"),
        ("Time, s", "Tracking error, mm"),
        ("Time, s", "Tracking indicator, mm²"),
        ("Time, s", "Energy error, kN·m"),
        ("Time, s", "Adaptation Δα"),
        ("Command displacement, mm", "Measured displacement, mm"),
    ):
        assert axes.count(wanted) >= 2, wanted
    assert ("Time, s", "Ground acceleration, g") in axes


def test_plots_keep_the_extremes_of_the_recording_in_shown_units(fourth: tuple[Recording, str]) -> None:
    recording, html = fourth
    spec = next(spec for spec in Page(html).specs if spec["y"] == "Tracking error, mm")
    drawn, error = unpacked(spec["traces"][0]["y"]), recording.signal("error.1") * 1e3
    assert (drawn.min(), drawn.max()) == pytest.approx((error.min(), error.max()), rel=1e-6)  # float32
    assert unpacked(spec["traces"][0]["x"])[-1] == pytest.approx(recording.time[-1], rel=1e-6)
    assert len(drawn) < len(error) / 10


def test_the_spectrum_marks_t1_and_the_spectral_acceleration_of_the_scaled_record(fourth: tuple[Recording, str]) -> None:
    recording, html = fourth
    mark = next(spec["mark"] for spec in Page(html).specs if "mark" in spec)
    motion = recording.plan.motion
    assert isinstance(motion, RecordMotion) and isinstance(motion.scale, Factor)
    record = MotionLibrary(None).get(motion.record).scaled(motion.scale.factor)
    period = float(Model(recording.plan).periods[0])
    assert mark["x"] == pytest.approx(period)
    assert mark["y"] == pytest.approx(spectral_acceleration(record, period) / 9.80665)
    text = Page(html).text
    assert record.title in text and record.provenance in text and f"by a factor, record × {motion.scale.factor:g}" in text


def test_a_stored_record_out_of_reach_is_replaced_by_the_recorded_acceleration(tmp_path: Path) -> None:
    library = MotionLibrary(tmp_path / "motions")
    library.add(Motion("own", "Own record", 0.01, np.sin(np.arange(800) * 0.05), provenance="made for this test"))
    motion = templates.template("two-storeys").motion.model_copy(update={"record": "own"})
    recording = recorded(tmp_path, shortened("two-storeys", motion=motion), library=library)
    with_record, without = Page(report_html(RUN, recording, library)), Page(report_html(RUN, recording))
    assert "made for this test" in with_record.text
    assert "ground acceleration in this recording" in without.text
    marks = [next(spec["mark"]["y"] for spec in page.specs if "mark" in spec) for page in (with_record, without)]
    assert marks[1] == pytest.approx(marks[0], rel=0.01)  # sampled every 9.8 ms instead of 10 ms, of a motion of 0.8 Hz


def test_the_plan_is_written_with_the_units_of_its_own_fields(fourth: tuple[Recording, str]) -> None:
    text = Page(fourth[1]).text
    for row in (
        "Lateral stiffness of the braces, kN/m",
        "662.9",
        "Measured force limit 1000 kN",
        "Integral gain ki 0.04 1/(mm²·s)",
        "Pace As fast as possible",
    ):
        assert row in text


def test_every_field_of_a_station_is_in_its_tables() -> None:
    station = Station()
    found = groups("Station", station)
    assert {group.title for group in found} == {
        "Station",
        "Delay compensator: Adaptive inverse (AIC)",
        "Actuator: First-order delay",
        "Specimen: MR damper (passive-on)",
        "Sensor noise",
        "Safety limits",
    }
    labels = {row.label for group in found for row in group.rows}
    for part in (station.compensator, station.actuator, station.specimen, station.noise, station.limits):
        assert {info.title for name, info in type(part).model_fields.items() if name != "kind"} <= labels


def test_the_report_needs_no_address_outside_itself(fourth: tuple[Recording, str]) -> None:
    for tag, attrs in Page(fourth[1]).tags:
        for name in ("src", "href", "srcset", "action", "data"):
            assert (attrs.get(name) or "data:").startswith("data:"), (tag, attrs)
    style = re.search(r"<style>(.*?)</style>", fourth[1], re.DOTALL)
    assert style and "url(" not in style[1] and "@import" not in style[1]


def test_the_report_is_plotly_once_and_less_than_2_mb_besides(fourth: tuple[Recording, str]) -> None:
    from app.reports.html import plotly

    assert fourth[1].count(plotly()) == 1
    assert len(fourth[1].encode()) - len(plotly().encode()) < 2e6


def test_many_stations_share_the_points_of_the_plots(tmp_path: Path) -> None:
    from app.reports.html import plotly

    station = templates.template("two-storeys").stations[0]
    stations = tuple(station.model_copy(update={"name": f"S{j}", "dampers": 1}) for j in range(12))
    html = report_html(RUN, recorded(tmp_path, shortened("two-storeys", stations=stations)))
    assert len(html.encode()) - len(plotly().encode()) < 2.5e6  # twelve stations' tables and alternative texts come on top


def test_headings_descend_without_gaps_and_every_plot_and_table_is_named(fourth: tuple[Recording, str]) -> None:
    page = Page(fourth[1])
    levels = [int(tag[1]) for tag, _ in page.tags if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))
    plots = [attrs for tag, attrs in page.tags if tag == "div" and attrs.get("class") == "plot"]
    assert len(plots) == len(page.specs) > 0
    assert all(attrs["role"] == "img" and len(attrs["aria-label"] or "") > 20 for attrs in plots)
    tables, captions = ([tag for tag, _ in page.tags].count(name) for name in ("table", "caption"))
    assert tables == captions
    assert all("scope" in attrs for tag, attrs in page.tags if tag == "th")


def test_markup_in_names_is_shown_as_text(tmp_path: Path) -> None:
    name = "</script><script>alert(1)</script>"
    plan = shortened("linear-damper", name=name)
    station = plan.stations[0].model_copy(update={"name": name})
    html = report_html({**RUN, "submitted_by": name}, recorded(tmp_path, plan.model_copy(update={"stations": (station,)})))
    assert "<script>alert" not in html and "&lt;script&gt;alert(1)" in html


def test_decimation_keeps_a_single_spike_of_each_sign_and_both_ends() -> None:
    signal = np.zeros((10_000, 1))
    signal[4321], signal[4322] = 5.0, -7.0
    kept = extremes(signal, 100)
    assert {0, 4321, 4322, 9_999} <= set(kept.tolist())
    assert len(kept) <= 2 * 100 + 2
    assert np.all(np.diff(kept) > 0)


def test_a_short_signal_is_kept_whole_and_arrays_are_packed_as_float32() -> None:
    assert extremes(np.zeros((50, 2)), 100).tolist() == list(range(50))
    assert len(extremes(np.zeros((0, 2)), 100)) == 0
    np.testing.assert_array_equal(unpacked(packed(np.array([1.5, -2.25]))), [1.5, -2.25])


def test_a_test_with_a_client_repeats_with_its_client_and_lists_late_ramps(fourth: tuple[Recording, str]) -> None:
    recording, text = fourth
    assert "gives the same numbers to the bit" in text
    client = {"waits": 3, "longest_wait_s": 0.0123}
    led = replace(recording, plan=recording.plan.model_copy(update={"test": "client"}))
    late = replace(led, summary={**led.summary, "client": client})
    assert "its program is in no digest" in repeating(led)
    said = " ".join(one for block in record(RUN, late) if isinstance(block, Text) for one in block.paragraphs)
    assert "3 ramps began late, the longest by 12.3 ms" in said and "none that" not in said
