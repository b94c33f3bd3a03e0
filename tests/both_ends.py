"""The order of test files on several workers (pytest-xdist): what waits beside what computes.

A test in a browser or of a whole service waits most of its time, and the others compute. Of two workers, the first takes the
files that wait and the second those that compute, each from its end of the list, until they meet: two cores are busy all the
time, no browser has to share them with another one, and both workers end together.
"""

from __future__ import annotations

from collections import OrderedDict
from pathlib import Path
from typing import Any

from xdist.scheduler import LoadFileScheduling  # type: ignore[import-untyped]

ROOT = Path(__file__).parent.parent


class BothEnds(LoadFileScheduling):  # type: ignore[misc]
    """Whole files, from the front of the list to workers of even number and from its back to the others."""

    listed = False
    workqueue: OrderedDict[str, Any]

    def _assign_work_unit(self, node: Any) -> None:
        if not self.listed:
            self.workqueue = OrderedDict(sorted(self.workqueue.items(), key=lambda one: computing(one[0])))
            self.listed = True
        if int(node.gateway.id.removeprefix("gw")) % 2:
            self.workqueue.move_to_end(next(reversed(self.workqueue)), last=False)
        super()._assign_work_unit(node)


def computing(file: str) -> tuple[int, str]:
    """How much of its time a file of tests computes: its place in the list."""
    if file.startswith("tests/browser/"):
        return 0, file
    if "tests.browser.service" in (ROOT / file).read_text(encoding="utf-8"):
        return 1, file
    return (2 if file.startswith("tests/app/") else 3), file
