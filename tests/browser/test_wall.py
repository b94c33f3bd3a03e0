"""The wall display: what runs, readable from across the hall, without controls."""

from __future__ import annotations

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener
from tests.browser.service import Service, until

SMALLEST_PX = 20
SMALL_TEXT = """(smallest) => {
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const small = [];
  while (walker.nextNode()) {
    const text = walker.currentNode.data.trim();
    const element = walker.currentNode.parentElement;
    if (!text || !element.checkVisibility() || element.tagName === "SCRIPT") continue;
    const svg = element.closest("svg");
    const scale = svg ? svg.getScreenCTM().a : 1;
    const size = parseFloat(getComputedStyle(element).fontSize) * scale;
    if (size < smallest - 0.05) small.push([text, size]);
  }
  return small;
}"""


def whole(page: Page) -> bool:
    """Whether nothing lies beyond the window."""
    found: bool = page.evaluate(
        "[...document.querySelectorAll('.wall-test, .wall-body > *, .station, .wall-next')].every((one) => {"
        " const box = one.getBoundingClientRect();"
        " return box.right <= innerWidth + 1 && box.bottom <= innerHeight + 1; })"
        " && document.documentElement.scrollHeight <= innerHeight"
    )
    return found


def test_the_wall_follows_the_running_test_and_keeps_it_after_its_end(idle: Service, opened: Opener) -> None:
    page = opened("/wall", viewport={"width": 1920, "height": 1080})
    idle.submit(name="First", duration=6.0, pace={"kind": "real_time", "factor": 1.0})
    expect(page.locator("#wall-state")).to_have_text("Test running")
    expect(page.locator(".wall-name")).to_have_text("First")
    expect(page.locator(".station")).to_have_count(2)
    expect(page.locator(".gauge-now").first).not_to_have_text("–")
    assert page.locator("button, a, input, select").count() == 0
    for width, height in ((1920, 1080), (3840, 2160)):
        page.set_viewport_size({"width": width, "height": height})
        until(lambda: page.evaluate(SMALL_TEXT, SMALLEST_PX), lambda small: small == [])
        until(lambda: whole(page), bool)
    expect(page.locator("#wall-state")).to_have_text("No test is running")
    expect(page.locator(".wall-time")).to_contain_text("completed at 6.0")
    assert Axe().run(page).violations_count == 0


def test_the_wall_of_one_run_stays_with_it_and_says_why_it_tripped(idle: Service, opened: Opener) -> None:
    stations = idle.plan()["stations"]
    stations[0]["limits"]["velocity"] = 0.01
    run = idle.submit(name="Tight", stations=stations, duration=20.0)
    idle.wait(run, "tripped")
    page = opened(f"/wall?run={run}", viewport={"width": 2560, "height": 1440}, color_scheme="dark")
    expect(page.locator(".wall-reason")).to_contain_text("beyond its limit of 10 mm/s")
    expect(page.locator(".gauge[data-margin=over]")).to_have_count(1)
    assert whole(page)
    assert Axe().run(page).violations_count == 0
    missing = opened("/wall?run=nothing", allow=("404",))
    expect(missing.locator("main")).to_contain_text("nothing")
