"""Frames per second and time of an update of the page of a running test: `python -m benchmarks.live_page`.

A test of one station with 8 recorded channels at 1024 Hz runs in real time. Chromium without a graphics processor shows its
page at 1400 x 900. The time of an update is that of all scripts of one animation frame, including what they defer to its end
(uPlot draws there). Needs Chromium on the PATH.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright

from tests.browser.conftest import ARGUMENTS
from tests.browser.service import Service, running

SETTLE_S, MEASURED_S = 20.0, 20.0
TEMPLATE = "specimen-mr-damper"
SPY = """
window.updates = []; window.frames = []; window.painted = [];
const original = window.requestAnimationFrame.bind(window);
let begun = 0;
window.requestAnimationFrame = (callback) => original((now) => {
  const start = performance.now();
  callback(now);
  queueMicrotask(() => {
    const spent = performance.now() - start;
    if (begun === now) window.updates[window.updates.length - 1] += spent;
    else { begun = now; window.updates.push(spent); window.frames.push(now); }
  });
});
const paint = (now) => { window.painted.push(now); original(paint); };
original(paint);
"""


def main() -> None:
    """Measure a running test with all of it shown and with the last 20 s shown, and a replay, and print the figures as JSON."""
    chromium = shutil.which("chromium")
    if chromium is None:
        raise SystemExit("There is no Chromium on the PATH (Debian: apt-get install chromium).")
    with tempfile.TemporaryDirectory() as folder, running(Path(folder)) as service, sync_playwright() as playwright:
        service.warm_up()
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        page = browser.new_page(base_url=service.url, viewport={"width": 1400, "height": 900})
        page.add_init_script(SPY)
        run = _submit(service)
        page.goto(f"/runs/{run}")
        page.wait_for_timeout(1000 * SETTLE_S)
        found: dict[str, Any] = {"load_at_start": round(os.getloadavg()[0], 2)}
        found["live, whole test"] = _measured(page)
        page.get_by_label("Time shown").select_option("20")
        found["live, last 20 s"] = _measured(page)
        service.http.post(f"/api/v1/runs/{run}/cancel", json={})
        service.wait(run)
        page.get_by_label("Time shown").select_option("")
        page.locator("#play").click()
        found["replay"] = _measured(page)
        print(json.dumps(found, indent=2))
        browser.close()


def _submit(service: Service) -> str:
    plan = service.plan(TEMPLATE, pace={"kind": "real_time", "factor": 1.0})
    plan["drive"]["shape"]["cycles_each"] = 10
    return str(service.post("/runs", {"plan": plan})["runs"][0]["id"])


def _measured(page: Page) -> dict[str, float]:
    page.evaluate("updates.length = frames.length = painted.length = 0")
    page.wait_for_timeout(1000 * MEASURED_S)
    updates, frames, painted = (np.array(part) for part in page.evaluate("[updates, frames, painted]"))
    return {
        "updates_per_s": round((len(frames) - 1) / (frames[-1] - frames[0]) * 1000, 1),
        "frames_per_s": round((len(painted) - 1) / (painted[-1] - painted[0]) * 1000, 1),
        "update_median_ms": round(float(np.median(updates)), 2),
        "update_p95_ms": round(float(np.percentile(updates, 95)), 2),
    }


if __name__ == "__main__":
    main()
