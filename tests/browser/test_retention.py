"""Retention in the browser: the rule in the settings with its preview, and the page of a run whose recording was removed."""

from __future__ import annotations

import sqlite3
from contextlib import closing

from playwright.sync_api import expect

from app.cli.main import main
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible


def test_a_rule_is_previewed_saved_and_removes_a_recording(idle: Service, opened: Opener) -> None:
    run = idle.completed(name="Old calibration", duration=1.0)
    with closing(sqlite3.connect(idle.data / "rths.sqlite", timeout=60)) as rows, rows:
        rows.execute("UPDATE run SET finished_at = '2025-03-02 10:00:00.000000' WHERE id = ?", [run])
    page = opened("/settings")
    section = page.locator("#retention")
    expect(section).to_contain_text("Rule in force: All recordings are kept.")
    section.get_by_label("Keep recordings for (days)").fill("300")
    section.get_by_label("Keep recordings for (days)").press("Tab")
    expect(section.get_by_label("Preview")).to_contain_text("The rule removes 1 recording now")
    expect(section.get_by_role("link", name="Old calibration")).to_be_visible()
    section.get_by_role("button", name="Save the retention rule").click()
    expect(section).to_contain_text("Rule in force: A recording is removed 300 days after the end of its test. Next removal:")
    expect_accessible(page)
    assert main(["retention", "--data", str(idle.data)]) == 0
    section.get_by_label("Keep recordings for (days)").fill("")
    section.get_by_role("button", name="Save the retention rule").click()
    expect(section).to_contain_text("Rule in force: All recordings are kept.")
    page = opened(f"/runs/{run}")
    expect(page.locator("#waiting")).to_contain_text("Recording removed by retention on")
    expect(page.locator("#metrics")).to_contain_text("MTE")
    expect_accessible(page)
