"""The page of a run: gauges against limits, the replay, the drawing, gaps, the end of a test, keyboard and print."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from rths_engine.recordings import run_file
from tests.browser.conftest import Opener
from tests.browser.service import Service

DESK = {"width": 1400, "height": 900}
PEAK = re.compile(r"peak ([\d.]+)")


@pytest.fixture(scope="module")
def run(service: Service) -> str:
    """Six seconds of a hybrid test with two stations."""
    return service.completed(duration=6.0)


def recorded(service: Service, run: str) -> run_file.Recording:
    return run_file.load(service.data / "recordings" / f"{run}.h5")


def ready(page: Page) -> Page:
    expect(page.locator(".gauge-now").first).not_to_have_text("–")
    return page


def seek(page: Page, time: float) -> None:
    page.locator("#scrubber").evaluate("(one, time) => (one.value = time, one.dispatchEvent(new Event('input')))", time)
    expect(page.locator("#shown-time")).to_have_text(f"{time:.2f} s")


def peaks(page: Page, station: int) -> list[float]:
    texts = page.locator(".station").nth(station).locator(".gauge-peak").all_text_contents()
    return [float(found[1]) for text in texts if (found := PEAK.search(text))]


def test_gauges_show_the_peaks_that_the_safety_check_compares(service: Service, run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    recording = recorded(service, run)
    for station in (0, 1):
        command, force = recording.signal(f"x_cmd.{station + 1}"), recording.signal(f"f_meas.{station + 1}")
        velocity = np.diff(command, prepend=0.0) / recording.dt
        wanted = [1e3 * np.abs(command).max(), 1e3 * np.abs(velocity).max(), 1e-3 * np.abs(force).max()]
        expect(page.locator(".station").nth(station).locator(".gauge-peak").first).to_have_text(f"peak {wanted[0]:.1f}")
        assert peaks(page, station) == pytest.approx(wanted, abs=0.051)


def test_a_replay_moves_gauges_drawing_loop_and_signals_to_one_moment(service: Service, run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    recording = recorded(service, run)
    seek(page, 4.0)
    k = round(4.0 / recording.dt) - 1
    command = 1e3 * recording.signal("x_cmd.1")
    expect(page.locator(".gauge-now").first).to_have_text(re.compile(rf"^{command[k]:.1f}|{command[k - 1]:.1f}$"))
    assert peaks(page, 0)[0] == pytest.approx(np.abs(command[: k + 1]).max(), abs=0.06)
    expect(page.locator(".floor-now").last).to_contain_text(f"{1e3 * recording.signal('x_floor.2')[k]:.1f} mm")
    expect(page.get_by_role("img", name=re.compile("^Tracking error, at 4.00 s")).first).to_be_visible()
    expect(page.locator(".stage-loop .at")).to_have_text(re.compile(r"^at [34]\.\d{3} s$"))
    assert 60 < float(page.locator(".stage .veil").first.evaluate("veil => parseFloat(veil.style.left)")) < 70
    page.get_by_label("Speed of the replay").select_option("20")
    page.locator(".stage-time .plot").first.focus()
    page.keyboard.press(" ")
    expect(page.locator("#shown-time")).to_have_text(re.compile(r"^6\.0\d s$"))
    expect(page.locator("#play")).to_have_text("Play")
    expect(page.locator(".stage .veil").first).to_be_hidden()


def test_a_station_is_chosen_by_the_keyboard_and_the_loop_follows_cursor_and_zoom(run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    stations = page.get_by_role("radiogroup", name="Station shown")
    stations.get_by_role("radio").first.focus()
    page.keyboard.press("ArrowDown")
    expect(stations.get_by_role("radio").nth(1)).to_be_checked()
    expect(page.locator(".stage-loop strong")).to_have_text("Force against displacement, station 2")
    still = page.locator(".stage-loop .loop-still")
    whole = still.evaluate("canvas => canvas.toDataURL()")
    error = page.locator(".stage").get_by_role("img", name=re.compile("^Tracking error"))
    error.focus()
    page.keyboard.press("ArrowLeft")
    expect(page.locator(".stage-loop .at")).to_have_text(re.compile(r"^at [23]\.\d{3} s$"))
    page.keyboard.press("+")
    page.wait_for_function("whole => document.querySelector('.stage-loop .loop-still').toDataURL() !== whole", arg=whole)


def test_the_first_screen_holds_the_whole_test(run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    boxes = page.locator(".stage > *").evaluate_all("cells => cells.map(cell => cell.getBoundingClientRect().bottom)")
    assert len(boxes) == 4 and max(boxes) < DESK["height"] - 55  # the bar with Abort
    assert page.locator(".station").evaluate_all("all => all.every(one => one.scrollHeight <= one.clientHeight + 1)")


def test_a_trip_ends_the_axes_where_the_test_ended_and_is_marked_with_its_sentence(service: Service, opened: Opener) -> None:
    plan = service.plan(duration=20.0)
    plan["stations"][0]["limits"]["velocity"] = 0.02
    run = service.post("/runs", {"plan": plan})["runs"][0]["id"]
    trip = service.wait(run, "tripped")["trip"]
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    expect(page.locator(".trip-note")).to_have_text(trip["sentence"])
    gauge = page.locator(".station").first.locator(".gauge").nth(1)
    expect(gauge.locator(".gauge-peak")).to_have_text(f"peak {1e3 * abs(trip['value']):.2f}")
    expect(gauge.locator(".gauge-share")).to_contain_text("over limit")
    expect(page.locator(".station-ring").first).to_have_attribute("data-margin", "over")
    assert float(page.locator("#scrubber").get_attribute("max") or 0) == pytest.approx(trip["time_s"], abs=0.01)
    error = page.locator(".stage").get_by_role("img", name=re.compile("^Tracking error"))
    width = error.locator(".u-over").evaluate("over => over.clientWidth")
    error.locator(".u-over").hover(position={"x": 0.97 * width, "y": 10})
    at = page.locator(".stage-loop .at")
    expect(at).to_have_text(re.compile(r"^at [\d.]+ s$"))
    shown = float((at.text_content() or "").split()[1])
    assert 0.9 * trip["time_s"] < shown <= trip["time_s"]


def test_a_running_test_is_held_and_shown_live_again(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace={"kind": "real_time", "factor": 1.0})
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    page.get_by_role("button", name="Pause the replay").click()
    held = page.locator("#shown-time").text_content()
    expect(page.locator("#stage")).to_have_class("past")
    expect(page.locator("#clock")).not_to_have_text(re.compile(rf"^{held}"))
    assert page.locator("#shown-time").text_content() == held
    page.get_by_role("button", name="Show the newest sample").click()
    expect(page.locator("#stage")).not_to_have_class("past")
    expect(page.locator("#shown-time")).not_to_have_text(str(held))


def test_every_chart_is_printed_at_the_width_of_the_page(run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK, color_scheme="dark"))
    total = page.locator(".chart").count()
    assert page.locator(".charts .chart").last.locator("canvas").count() == 0  # not seen yet, so not drawn yet
    page.evaluate(f"addEventListener('beforeprint', () => (window.printed = ({INKED})()))")
    page.pdf(prefer_css_page_size=True)
    printed: list[dict[str, Any]] = page.evaluate("window.printed")
    assert len(printed) == total and all(one["ink"] > 100 and one["width"] <= 700 for one in printed)
    expect(page.locator("html")).not_to_have_class("printing")
    assert page.locator(".stage-time").evaluate("cell => cell.clientWidth") > 1000


INKED = """() => [...document.querySelectorAll('.chart')].map(chart => {
  const canvas = chart.querySelector('canvas');
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let ink = 0;
  for (let i = 3; i < data.length; i += 4) ink += data[i] > 0;
  return { ink, width: canvas.getBoundingClientRect().width };
})"""

MISSING = """async () => {
  const { Store } = await import('/static/js/run/store.js');
  const { Envelope } = await import('/static/js/run/envelope.js');
  const { through } = await import('/static/js/run/loop_path.js');
  const channel = (role) => ({ key: `${role}.1`, role, number: 1, label: role, unit: '', factor: 1 });
  const channels = [channel('ti'), channel('error')];
  const store = new Store({ run: null, attempt: 1, dt: 0.01, bucket: 1, buckets: 200, channels });
  const frame = new ArrayBuffer(8 + 200 * 24);
  new Uint32Array(frame, 0, 2).set([0, 200]);
  const values = new Float32Array(frame, 8);
  for (let k = 0; k < 200; k++) {
    const missing = k === 0 || (k >= 50 && k < 60);
    values.set([missing ? NaN : k, missing ? NaN : k, missing ? NaN : k, k, k, k], 6 * k);
  }
  store.take(frame);
  const fill = (columns) => {
    const envelope = new Envelope(2);
    envelope.fill(store, [0, 1], 0, 2, columns);
    return envelope.views;
  };
  const [fine, coarse] = [fill(400), fill(20)];
  const moves = [];
  through({ moveTo: (x) => moves.push(x), lineTo() {} }, store.last[0], store.last[0], 0, 200, (x) => x, (y) => y);
  return {
    first: fine[1][0], gap: fine[1].slice(98, 122), plain: Array.isArray(fine[1]), fast: fine[2] instanceof Float32Array,
    coarse: Array.from(coarse[1]).filter((one) => one === null).length, moves,
    range: [store.lowest[0], store.highest[0]], early: store.moment(0.3).highest[0],
  };
}"""


def test_a_missing_sample_is_a_gap_and_leaves_the_scale_alone(run: str, opened: Opener) -> None:
    found = opened(f"/runs/{run}").evaluate(MISSING)
    assert found["first"] is None and found["plain"] and found["fast"]
    assert found["gap"] == [49, 49, *[None] * 20, 60, 60]
    assert found["coarse"] == 2  # one column has no sample; a column that has some is no gap
    assert found["moves"] == [1, 60]
    assert found["range"] == [1, 199] and found["early"] == 29


def test_gaps_reach_the_plot_and_its_scale_stays_finite(run: str, opened: Opener) -> None:
    page = ready(opened(f"/runs/{run}", viewport=DESK))
    found = page.evaluate(
        """async () => {
          const { TimeChart } = await import('/static/js/run/time_chart.js');
          const { View } = await import('/static/js/run/view.js');
          const { Store } = await import('/static/js/run/store.js');
          const channels = [{ key: 'ti.1', role: 'ti', number: 1, label: 'TI', unit: '', factor: 1 }];
          const store = new Store({ run: null, attempt: 1, dt: 0.01, bucket: 1, buckets: 100, channels });
          const frame = new ArrayBuffer(8 + 100 * 12);
          new Uint32Array(frame, 0, 2).set([0, 100]);
          new Float32Array(frame, 8).fill(5).fill(NaN, 0, 3).fill(7, 150);
          store.take(frame);
          const chart = new TimeChart(new View(store), 'TI', '', [{ index: 0, label: '', unit: '', colour: '--ink-line' }]);
          document.querySelector('.charts').append(chart.figure.element);
          chart.draw();
          await new Promise(requestAnimationFrame);
          return [chart.plot.data[1][0], chart.plot.scales.y.min, chart.plot.scales.y.max];
        }"""
    )
    assert found[0] is None and 4 < found[1] < 5 and 7 < found[2] < 8


@pytest.mark.parametrize(
    ("template", "drawn"), [("specimen-mr-damper", "Drawing of the rig"), ("structure-matrices", "Drawing of the building")]
)
def test_what_is_tested_is_drawn(template: str, drawn: str, service: Service, opened: Opener) -> None:
    page = ready(opened(f"/runs/{service.completed(template=template, duration=3.0)}", viewport=DESK))
    drawing = page.get_by_role("img", name=re.compile(f"^{drawn}"))
    moving = ".measured-mark" if template.startswith("specimen") else ".slab"
    seek(page, 3.0)
    seek(page, 1.0)
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    before = drawing.locator(moving).last.get_attribute("transform")
    seek(page, 1.9)
    expect(drawing.locator(moving).last).not_to_have_attribute("transform", str(before))
    expect(page.locator(".schematic-caption")).to_contain_text("the ruler" if template.startswith("specimen") else "×")
