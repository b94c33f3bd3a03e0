"""The page of a comparison: what differs in words and tables, curves that are shown, hidden, zoomed and read by keyboard."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener, visit
from tests.browser.service import Service, until


def cycles(service: Service, frequency: float) -> dict[str, Any]:
    shape = {"kind": "sine", "frequency": frequency, "cycles": 2 * frequency, "ramps": 0.5}
    plan = service.plan("specimen-mr-damper", drive={"amplitude": 0.01, "shape": shape}, name=f"Cycles at {frequency:g} Hz")
    return {**plan, "template": None}


@pytest.fixture(scope="module")
def pair(service: Service) -> list[str]:
    runs = service.post("/runs", {"plans": [cycles(service, 1.0), cycles(service, 2.0)]})["runs"]
    return [str(service.wait(run["id"], "completed")["id"]) for run in runs]


def drawn(page: Page, title: str) -> int:
    """Number of pixels that are not transparent in the plot of a chart."""
    found: int = page.locator("#charts figure", has_text=title).first.evaluate(
        """figure => {
          const canvas = figure.querySelector("canvas");
          const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          let count = 0;
          for (let k = 3; k < data.length; k += 4) if (data[k]) count += 1;
          return count;
        }"""
    )
    return found


def test_excitations_that_differ_are_said_first_and_curves_follow_the_legend_and_the_zoom(
    pair: list[str], opened: Opener
) -> None:
    page = opened(f"/compare?items=run:{pair[0]},run:{pair[1]}", allow=("willReadFrequently",))
    expect(page.locator(".notes li").first).to_contain_text("The excitations differ: Drive: Shape: Frequency is 1 Hz in Run")
    expect(page.locator(".compared").first.locator("tbody tr")).to_have_count(2)
    expect(page.locator(".compared").first.locator("tbody code")).to_have_text(["drive.shape.frequency", "drive.shape.cycles"])
    expect(page.locator("td.differs").first).to_have_text("2")
    command = page.locator("#charts figure", has_text="Command displacement, mm").locator(".plot").first
    command.focus()
    page.keyboard.press("ArrowRight")
    expect(page.locator("#legend-of")).to_contain_text("Command displacement, mm at 1.0")
    values = page.locator("#legend .value")
    expect(values.first).not_to_have_text("")
    both = drawn(page, "Command displacement")
    page.locator("#legend input").nth(1).uncheck()
    until(lambda: drawn(page, "Command displacement"), lambda left: 0 < left < both)
    page.get_by_role("button", name="Show all items").click()
    page.locator("#legend .entry").nth(1).hover()
    expect(page.locator("#legend .entry").nth(1)).to_have_class(re.compile("highlighted"))
    command.focus()
    page.keyboard.press("+")
    expect(page.locator("#zoomed")).to_contain_text("Shown: ")
    with page.expect_response(lambda answer: "/compare/signals" in answer.url and "from_s=" in answer.url):
        page.keyboard.press("+")
    page.keyboard.press("Escape")
    expect(page.locator("#zoomed")).to_have_text("")


def test_another_item_becomes_the_reference_and_the_run_page_leads_to_comparisons(pair: list[str], opened: Opener) -> None:
    page = opened(f"/compare?items=run:{pair[0]},run:{pair[1]}")
    page.get_by_role("link", name="Make Run", exact=False).click()
    expect(page).to_have_url(re.compile(f"&reference=run:{pair[1]}$"))
    expect(page.locator("#measures")).to_contain_text("Measures, with their differences to Run")
    visit(page, f"/runs/{pair[1]}")
    page.get_by_role("link", name="Compare with other runs").click()
    expect(page.locator("#count")).to_have_text("1 item is chosen; choose 2 to 20.")
    expect(page.get_by_role("button", name="Compare items")).to_be_disabled()
    page.locator(f"input[value='run:{pair[0]}']").check()
    page.get_by_role("button", name="Compare items").click()
    expect(page).to_have_url(re.compile(f"items=run:{pair[1]},run:{pair[0]}$"))
    visit(page, f"/runs/{pair[1]}")
    page.get_by_role("link", name="Compare with the previous run").click()
    expect(page.locator("[role=alert].banner")).to_contain_text("There is no earlier run of the same template or name")
