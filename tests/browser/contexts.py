"""Contexts of the browser that tests use one after another: a page finds in their cache the modules that an earlier one loaded.

In a new context a page reads and compiles 30 to 90 modules, which takes three times the processor time of the page itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import Browser, BrowserContext

PATIENCE_MS = 60_000  # of each step, on a busy machine
MOST_FREE = 12

Taker = Callable[..., BrowserContext]


class Kept:
    """A context with a blank page, which keeps its window between tests."""

    def __init__(self, browser: Browser, key: str, origin: str, who: str, options: dict[str, Any]):
        self.key, self.origin = key, origin
        self.context = browser.new_context(base_url=origin, accept_downloads=True, **options)
        self.context.set_default_timeout(PATIENCE_MS)
        self.context.add_init_script(f"localStorage.setItem('rths.name', {who!r})" if who else "")
        self.context.on("page", lambda page: page.add_locator_handler(page.locator("html[data-loading]"), lambda: None))
        self._blank = self.context.new_page()
        self._tools = self.context.new_cdp_session(self._blank)

    def empty(self) -> None:
        """Close the pages and remove what they stored; the cache of files stays."""
        for page in self.context.pages:
            if page is not self._blank:
                page.close()
        self.context.unroute_all(behavior="ignoreErrors")
        self.context.clear_cookies()
        self._tools.send("Storage.clearDataForOrigin", {"origin": self.origin, "storageTypes": "all"})


class Contexts:
    """The contexts of one browser. Two that a test takes are never the same, and neither has data of an earlier test."""

    def __init__(self, browser: Browser):
        self._browser = browser
        self._free: list[Kept] = []

    @contextmanager
    def taken(self) -> Iterator[Taker]:
        """A function that takes a context of an origin, a person and options of a window, until the end of a test."""
        mine: list[Kept] = []

        def take(origin: str, who: str = "", **options: Any) -> BrowserContext:
            mine.append(self._take(origin, who, options))
            return mine[-1].context

        try:
            yield take
        finally:
            for one in mine:
                one.empty()
            self._free += mine
            while len(self._free) > MOST_FREE:
                self._free.pop(0).context.close()

    def _take(self, origin: str, who: str, options: dict[str, Any]) -> Kept:
        key = repr((origin, who, sorted(options.items())))
        for one in self._free:
            if one.key == key:
                self._free.remove(one)
                return one
        return Kept(self._browser, key, origin, who, options)
