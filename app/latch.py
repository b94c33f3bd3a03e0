"""The latch of Abort: set in memory at once, by the web service and by every worker, before any database knows of it.

Each press of Abort has an identifier. Services and workers tell each other all presses and all releases that they know, in any
order and as often as they like: a release names the presses that it ends, so an old message never sets a released latch again.
"""

from __future__ import annotations

import threading
import uuid
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from typing import Any

REMEMBERED = 500  # releases


@dataclass(frozen=True, slots=True)
class Press:
    """One press of Abort: who, and when (UTC, ISO 8601)."""

    id: str
    by: str
    at: str

    @property
    def time(self) -> datetime:
        return datetime.fromisoformat(self.at)


class Latch:
    """The presses that are not released. While there is one, no test starts and every running test stops. Threads share it."""

    def __init__(self) -> None:
        self._presses: dict[str, Press] = {}
        self._released: deque[str] = deque(maxlen=REMEMBERED)
        self._lock = threading.Lock()
        self._listeners: list[Callable[[], None]] = []

    @property
    def held(self) -> bool:
        return bool(self._presses)

    @property
    def presses(self) -> list[Press]:
        """The presses that are not released, in the order in which they came."""
        with self._lock:
            return list(self._presses.values())

    @property
    def by(self) -> str | None:
        """Who pressed Abort first; None where the latch is not set."""
        return next((one.by for one in self.presses), None)

    def press(self, by: str) -> Press:
        """Set the latch."""
        one = Press(str(uuid.uuid4()), by, datetime.now(UTC).isoformat())
        self.merge([one], [])
        return one

    def merge(self, presses: Iterable[Press], released: Iterable[str]) -> None:
        """Take presses and releases that another service or worker knows."""
        with self._lock:
            before = set(self._presses)
            for ended in released:
                if ended not in self._released:
                    self._released.append(ended)
                self._presses.pop(ended, None)
            for one in presses:
                if one.id not in self._released:
                    self._presses.setdefault(one.id, one)
            changed = before != set(self._presses)
        if changed:
            for listener in list(self._listeners):
                listener()

    def listen(self, listener: Callable[[], None]) -> None:
        """Call `listener` after each change, in the thread of the change."""
        self._listeners.append(listener)

    def forget(self, listener: Callable[[], None]) -> None:
        """Do not call `listener` any more."""
        self._listeners.remove(listener)

    def as_dict(self) -> dict[str, Any]:
        """What to tell others."""
        with self._lock:
            return {"presses": [asdict(one) for one in self._presses.values()], "released": list(self._released)}

    def take(self, told: dict[str, Any]) -> None:
        """Merge what another told, `as_dict`."""
        self.merge([Press(one["id"], one["by"], one["at"]) for one in told["presses"]], told["released"])
