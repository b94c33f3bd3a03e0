"""Time to open a comparison of 20 runs of 40 s (40 960 samples): by REST, and the page in Chromium until its charts are drawn.

`python -m benchmarks.compare` measures in a service of its own. "first" reads the recordings; "again" is the median of repeats.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, sync_playwright

from tests.browser.conftest import ARGUMENTS
from tests.browser.service import Service, running

RUNS = 20
REPEATS = 5
DRAWN = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now()))))"


def compare() -> dict[str, Any]:
    """Seconds of each request, of the page until it is drawn, and processor seconds of the service for all signals."""
    with tempfile.TemporaryDirectory(prefix="rths-bench-") as folder, running(Path(folder)) as service:
        service.warm_up()
        plan = service.plan("two-storeys", duration=40.0)
        ids = [run["id"] for run in service.post("/runs", {"plans": [{**plan, "seed": k} for k in range(RUNS)]})["runs"]]
        for run in ids:
            service.wait(run, "completed", within_s=300)
        items = ",".join(f"run:{run}" for run in ids)
        before = _processor(service.pid)
        first = _timed(lambda: service.http.get(f"/api/v1/compare/signals?items={items}&points=1000").raise_for_status())
        spent = _processor(service.pid) - before
        signals = [
            _timed(lambda: service.http.get(f"/api/v1/compare/signals?items={items}&points=1000")) for _ in range(REPEATS)
        ]
        fields = [_timed(lambda: service.get(f"/compare?items={items}")) for _ in range(REPEATS)]
        found = {
            "runs": RUNS,
            "signals_first_s": round(first, 3),
            "signals_first_processor_s": round(spent, 3),
            "signals_again_s": round(statistics.median(signals), 3),
            "fields_and_measures_s": round(statistics.median(fields), 3),
            "page_drawn_s": _page(service, items),
            "load": round(os.getloadavg()[0], 1),
        }
    return {"compare": found}


def _page(service: Service, items: str) -> list[float]:
    """Seconds from the request to the drawn charts, sorted; each in a new context, with an empty cache."""
    path = shutil.which("chromium")
    if path is None:
        return []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        found = sorted(_opened(browser, service, items) for _ in range(REPEATS))
        browser.close()
    return found


def _opened(browser: Browser, service: Service, items: str) -> float:
    page = browser.new_page(base_url=service.url, viewport={"width": 1400, "height": 900})
    page.goto(f"/compare?items={items}", wait_until="commit")
    page.locator("#charts[aria-busy=false] figure").first.wait_for()
    page.evaluate("document.getElementById('signals').scrollIntoView()")
    drawn = page.evaluate(DRAWN)
    page.close()
    return round(float(drawn) / 1000, 3)


def _timed(work: Callable[[], Any]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _processor(pid: int) -> float:
    """Processor seconds of a process so far."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    print(json.dumps(compare(), indent=2))
