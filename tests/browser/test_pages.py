"""Every page, in both themes and on a phone: whole, quiet, within its width and usable with assistive technology."""

from __future__ import annotations

import json
import time
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import Opener, visit
from tests.browser.service import Service, until
from tests.engine import batch_files

LOOKS: dict[str, dict[str, Any]] = {
    "light": {"color_scheme": "light"},
    "dark": {"color_scheme": "dark"},
    "phone": {"color_scheme": "light", "viewport": {"width": 390, "height": 800}},
}
LATE_S = 0.03  # of each answer: pages are painted before it comes
MOST_MOVED = 0.01  # share of the window, weighted by the distance; a bar that pushes the page down by a line makes 0.02
# what shows that a page has all its content
CONTENT = {
    "/": ".headline:has(#recent-title) + div tbody tr",
    "/queue": "#waiting-none",
    "/new": ".good",
    "/help": "#shortcuts dd",
    "/wall": "#wall-clock",
    "/plans": "#plans tbody tr",
    "/plans/{plan}": "#versions tbody tr",
    "/runs": "#rows tr",
    "/runs/{run}": "#metrics tbody tr",
    "/stability/two-storeys": "#map .plot-container",
    "/stability/{run}": "#map .plot-container",
    "/table4": ".table4 tbody tr",
    "/league": ".league tbody tr",
    "/recordings": "tbody tr",
    "/recordings/{recording}": "#plots canvas",
    "/recordings/batches/{batch}": "tbody tr",
    "/compare": "#choose tbody tr",
    "/compare?items=run:{run},recording:{recording}": ".compared tbody tr",
    "/audit": "#rows tr",
    "/sweeps": "tbody tr",
    "/sweeps/new?template=two-storeys": "#name",
    "/sweeps/{sweep}": "#tornado .main-svg",
    "/diagnoses": "tbody tr",
    "/diagnoses/{diagnosis}": "#detail-1 + .panels figure:last-child svg.main-svg",
}


@pytest.fixture(scope="module")
def run(service: Service) -> str:
    return service.completed()


@pytest.fixture(scope="module")
def recording(service: Service) -> str:
    rows = "".join(f"{k / 100},{k % 50},{k % 25}\n" for k in range(400))
    sent = service.http.post(
        "/api/v1/recordings/files", files={"file": ("saw.csv", f"t (s),disp (mm),force (kN)\n{rows}")}
    ).json()
    imported: str = service.post("/recordings", {"file": sent["sha256"], "mapping": sent["guess"]})["id"]
    return imported


@pytest.fixture(scope="module")
def batch(service: Service) -> str:
    files = [("files", (name, raw)) for name, raw in batch_files.fifty().items()]
    form = {"mapping": json.dumps(batch_files.mapping())}
    return str(service.http.post("/api/v1/recordings/batches", files=files, data=form).json()["id"])


@pytest.fixture(scope="module")
def plan(service: Service) -> str:
    return str(service.post("/library/plans", {"plan": service.plan(), "name": "Kept", "tags": ["steel"]})["id"])


@pytest.fixture(scope="module")
def sweep(service: Service) -> str:
    fields = [{"path": "structure.damping_ratio", "values": [0.01, 0.05]}]
    definition = {"name": "Damping", "plan": service.plan(duration=0.5), "fields": fields}
    queued = service.post("/sweeps", {"sweep": definition})["id"]
    until(lambda: service.get(f"/sweeps/{queued}")["state"], lambda state: state == "completed", 150)
    return str(queued)


@pytest.fixture(scope="module")
def shown(run: str, recording: str, batch: str, diagnosed: str, plan: str, sweep: str) -> dict[str, str]:
    return {"plan": plan, "run": run, "recording": recording, "batch": batch, "diagnosis": diagnosed, "sweep": sweep}


@pytest.mark.parametrize("look", ["desk", "phone"])
@pytest.mark.parametrize("path", CONTENT)
def test_a_page_is_whole_quiet_and_accessible(path: str, look: str, shown: dict[str, str], opened: Opener) -> None:
    page = opened(path.format(**shown), reduced_motion="reduce", **LOOKS["dark" if look == "desk" else look])
    expect(page.locator(CONTENT[path]).first).to_be_visible()
    expect_accessible(page)
    expect(page.get_by_role("heading", level=1)).to_have_count(1)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
    if look == "desk":
        page.emulate_media(color_scheme="light", reduced_motion="reduce")  # colours change at once
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        expect_accessible(page)


FILLED = (
    *("/queue", "/new?template=two-storeys", "/plans", "/plans/{plan}", "/runs", "/runs/{run}"),
    *("/recordings", "/stability/{run}", "/settings"),
)
MOVES = """() => {
  window.moved = 0;
  const sum = (list) => { for (const { value } of list.getEntries()) window.moved += value; };
  new PerformanceObserver(sum).observe({ type: "layout-shift", buffered: true });
}"""


def test_nothing_moves_under_the_pointer_while_a_page_loads(shown: dict[str, str], opened: Opener) -> None:
    """A link that moves between press and release loses the click. The answers of the service come late here."""
    page = opened("/help")
    page.add_init_script(f"({MOVES})()")
    page.route("**/api/v1/**", late)
    moved = {}
    for path in FILLED:
        visit(page, path.format(**shown))
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        moved[path] = page.evaluate("window.moved")
    page.unroute_all(behavior="ignoreErrors")
    assert {path: moves for path, moves in moved.items() if moves > MOST_MOVED} == {}


def late(route: Route) -> None:
    time.sleep(LATE_S)
    route.continue_()


def test_an_unknown_page_says_so_and_leads_back(opened: Opener) -> None:
    page = opened("/nowhere", allow=("404",))
    expect(page.get_by_role("heading", name="Not found")).to_be_visible()
    expect_accessible(page)
    page.get_by_role("link", name="Open the Lab").click()
    expect(page).to_have_title("Lab · RTHS control room")


def test_an_unknown_run_says_so(opened: Opener) -> None:
    page = opened("/runs/not-a-run", allow=("404",))
    expect(page.get_by_text("There is no run not-a-run.")).to_be_visible()


def test_the_theme_chosen_is_kept(opened: Opener) -> None:
    page = opened("/", color_scheme="light")
    page.get_by_role("button", name="Dark theme").click()
    page.get_by_role("link", name="Runs", exact=True).click()
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")
    expect(page.get_by_role("button", name="Light theme")).to_be_visible()


def test_the_first_tab_stop_skips_to_the_content(opened: Opener) -> None:
    page = opened("/runs")
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip to the content")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator("main")).to_be_focused()


def expect_accessible(page: Page) -> None:
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
