"""The pages of sweeps: a form with a preview, and results that are filtered, chosen and run with full recording."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Opener, visit
from tests.browser.service import Service


def test_a_sweep_is_set_up_previewed_queued_and_its_points_are_compared(opened: Opener, service: Service) -> None:
    plan = service.plan("two-storeys", duration=1.0)
    kept = service.post("/library/plans", {"plan": plan, "name": "Short test of two storeys"})
    page = opened(f"/sweeps/new?library={kept['id']}", allow=("422",))
    expect(page.locator("#name")).to_have_value(f"Sweep of {plan['name']}")
    expect(page.locator("#queue")).to_be_disabled()
    page.locator("#search").fill("damping ratio")
    page.locator("#search").press("Enter")
    page.locator("#found button", has_text="structure.damping_ratio").click()
    field = page.locator(".varied")
    expect(field).to_contain_text("Planned: 2 %, bounds 0 to 100 %")
    field.get_by_label("Values, with commas between them, %").fill("1, 120")
    expect(field.locator(".error")).to_contain_text("needs a value < 100 %")
    field.get_by_label("Values, with commas between them, %").fill("1, 5")
    page.locator("#scale").select_option("factor")
    page.locator("#scale-values").fill("0.2 to 0.6 in 3")
    expect(page.locator("#preview")).to_contain_text("6 points")
    expect(page.locator("#preview")).to_contain_text("predicted")
    page.get_by_role("button", name="Queue sweep of 6 points").click()
    expect(page.locator("h1")).to_have_text(f"Sweep of {plan['name']}")
    expect(page.locator("#state")).to_have_text("completed", timeout=150_000)
    expect(page.locator("#standing")).to_contain_text("6 of 6 points done")
    expect(page.locator("#points tbody tr")).to_have_count(6)
    for plot in ("#heat", "#tornado", "#fragility"):
        expect(page.locator(f"{plot} .main-svg").first).to_be_visible()
    page.get_by_role("button", name=re.compile("^Structure: Damping ratio")).click()
    page.get_by_role("button", name=re.compile("^Structure: Damping ratio")).click()
    expect(page.locator("#points tbody tr").first.locator("td").nth(3)).to_have_text("5.00")
    page.locator("#status").select_option("invalid")
    expect(page.locator("#page")).to_have_text("No point passes the filters.")
    page.locator("#status").select_option("")
    page.get_by_role("button", name="Choose point 1", exact=True).click()
    page.get_by_role("button", name="Choose point 6", exact=True).click()
    for point in (1, 6):
        page.get_by_role("button", name=f"Run point {point} with full recording").click()
    expect(page.get_by_role("link", name="Compare the 2 runs")).to_have_attribute(
        "href", re.compile("/compare\\?items=run:.+,run:.+")
    )
    visit(page, "/sweeps")
    expect(page.locator("tbody tr").first).to_contain_text("6 of 6")
