"""A running test in the browser: seen live, seen again after a reload, cancelled and aborted."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, WebSocketRoute, expect

from tests.browser.conftest import Opener, loaded, visit
from tests.browser.service import Service

REAL_TIME = {"kind": "real_time", "factor": 1.0}


def test_a_reload_mid_run_shows_the_whole_history(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace=REAL_TIME)
    page = opened(f"/runs/{run}")
    _expect_simulated(page, 3)
    page.reload()
    loaded(page)
    expect(page.locator(".chart canvas").first).to_be_visible()
    error = page.get_by_role("img", name=re.compile("^Tracking error")).first
    _to_the_left_edge(page, error)
    expect(error).to_have_attribute("aria-label", re.compile(r"at 0\.00 s: -?\d"))
    expect(page.locator("#state")).to_have_text("running")


def test_measures_show_while_the_test_runs_and_end_as_those_stored(idle: Service, opened: Opener) -> None:
    idle.post("/queue/hold", {"by": "Bo"})
    run = idle.submit(duration=6.0, pace=REAL_TIME)
    page = opened(f"/runs/{run}")
    idle.post("/queue/release", {})  # the test starts before the eyes of the page
    stroke = page.locator(".tiles").first.get_by_text("Peak stroke").locator("xpath=following-sibling::dd")
    expect(stroke).to_have_text(re.compile(r"^\d+\.\d mm$"))
    expect(page.locator("#state")).to_have_text("running")
    expect(page.get_by_role("img", name=re.compile("^Synchronisation subspace"))).to_have_count(2)
    stored = idle.wait(run, "completed")
    for station, tiles in zip(stored["stations"], page.locator(".tiles").all(), strict=False):
        delay = tiles.get_by_text("FEI delay").locator("xpath=following-sibling::dd")
        expect(delay).to_have_text(f"{station['fei_delay_ms']:z.2f} ms")
    expect(page.locator(".tiles").last).to_contain_text(f"{stored['input_energy_kNm']:.1f} kN·m")


def test_a_lost_connection_is_told_and_mended(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace=REAL_TIME)
    page = opened("/runs")
    refused: list[str] = []

    def answer(socket: WebSocketRoute) -> None:
        if len(refused) < 3:
            refused.append(socket.url)
            socket.close(code=1011)
        else:
            socket.connect_to_server()

    page.route_web_socket("**/live*", answer)
    visit(page, f"/runs/{run}")
    expect(page.get_by_text("Connection lost, reconnecting …")).to_be_visible()
    _expect_simulated(page, 3)
    expect(page.get_by_text("Connection lost, reconnecting …")).to_be_hidden()


def test_a_running_test_is_cancelled_and_keeps_what_was_recorded(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace=REAL_TIME)
    page = opened(f"/runs/{run}")
    _expect_simulated(page, 1)
    page.get_by_role("button", name="Cancel this test").click()
    page.get_by_role("button", name="Cancel the test").click()
    expect(page.locator("#state")).to_have_text("cancelled")
    expect(page.locator("#reason")).to_contain_text("Stopped by Ana Ruiz")
    page.get_by_text("Download", exact=True).click()
    expect(page.get_by_role("link", name="Recording, HDF5")).to_be_visible()


def test_abort_asks_once_more_then_stops_the_test_and_holds_the_queue(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace=REAL_TIME)
    idle.wait(run, "running")
    page = opened("/runs")
    bar = page.get_by_role("region", name="Abort")
    expect(bar).to_contain_text("It is NOT the laboratory's emergency stop.")
    page.get_by_role("button", name="Abort").focus()
    place = bar.get_by_role("button").bounding_box()
    page.keyboard.press("Enter")
    assert idle.get(f"/runs/{run}")["state"] == "running"
    expect(bar.get_by_role("button", name="Press again to abort")).to_be_focused()
    assert bar.get_by_role("button").bounding_box() == place  # the second press does not miss it
    page.keyboard.press("Enter")
    assert idle.wait(run)["state"] == "cancelled"
    visit(page, "/")
    expect(page.locator("#held")).to_contain_text("The queue is held by Ana Ruiz")
    waiting = idle.submit(name="Held back", duration=1.0)
    expect(page.locator(f"#queued-{waiting}")).to_contain_text("Held back")
    page.get_by_role("button", name="Release the queue").click()
    expect(page.locator(f"#recent-{waiting}")).to_contain_text("completed")
    expect(page.locator("#held")).to_have_count(0)


def test_a_link_pressed_while_the_page_is_brought_up_to_date_still_leads_on(service: Service, opened: Opener) -> None:
    page = opened(f"/runs/{service.completed()}")
    link = page.get_by_role("link", name="Diagnose this run")
    link.hover()
    page.mouse.down()
    with page.expect_response("**/api/v1/runs/*"):
        page.evaluate("document.dispatchEvent(new Event('aborted'))")  # as when another page stops the tests
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    page.mouse.up()
    page.wait_for_url("**/diagnoses?run=*")


def test_the_lab_page_keeps_the_focus_while_it_refreshes(idle: Service, opened: Opener) -> None:
    run = idle.submit(duration=40.0, pace=REAL_TIME)
    idle.wait(run, "running")
    page = opened("/")
    cancel = page.locator(f"#cancel-{run}")
    cancel.focus()
    for _ in range(2):
        with page.expect_response("**/lab"):
            pass
    expect(cancel).to_be_focused()
    expect(page.locator(f"#running-{run} progress")).to_have_js_property("max", 40)


def test_the_charts_are_zoomed_with_the_keyboard(idle: Service, opened: Opener) -> None:
    page = opened(f"/runs/{idle.completed(duration=10.0)}")
    error = page.get_by_role("img", name=re.compile("^Tracking error")).first
    expect(error.locator("canvas")).to_be_visible()
    _to_the_left_edge(page, error)
    expect(error).to_have_attribute("aria-label", re.compile(r"at 0\.00 s"))
    page.keyboard.press("ArrowRight")
    for _ in range(5):
        page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("+")
    _to_the_left_edge(page, error)
    expect(error).to_have_attribute("aria-label", re.compile(r"at 0\.[1-9]\d s|at [1-9]\.\d\d s"))
    page.keyboard.press("Escape")
    _to_the_left_edge(page, error)
    expect(error).to_have_attribute("aria-label", re.compile(r"at 0\.00 s"))


def _to_the_left_edge(page: Page, chart: Locator) -> None:
    chart.focus()
    for _ in range(30):
        page.keyboard.press("Shift+ArrowLeft")


def _expect_simulated(page: Page, seconds: int) -> None:
    expect(page.locator("#clock")).to_have_text(re.compile(rf"^([{seconds}-9]|[1-9]\d)\.\d\d of 40.00 s simulated"))
