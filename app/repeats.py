"""Lines of the log that repeat: some of them are written, the others are counted and said once a minute.

Without this, a client fills the disk by asking for what is refused.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TextIO

MOST = 10  # equal lines within SAME_S that are written
SAME_S = 60.0
MOST_KINDS = 1000  # that are counted apart
REFUSED = 400  # statuses from this one on
SAME = ("method", "route", "status", "account", "run", "worker")
Key = tuple[object, ...]
Fields = Callable[[logging.LogRecord], Mapping[str, object]]


@dataclass(slots=True)
class _Repeated:
    first: logging.LogRecord
    fields: Mapping[str, object]
    since: float
    count: int = 1


class Bounded(logging.StreamHandler[TextIO]):
    """A handler that writes MOST equal lines a minute. Lines are equal where a person would count them: see `key_of`.

    `fields` gives what a line is about.
    """

    def __init__(self, stream: TextIO, fields: Fields, clock: Callable[[], float] = time.monotonic):
        super().__init__(stream)
        self._fields, self._clock = fields, clock
        self._known: dict[Key, _Repeated] = {}
        self._timer: threading.Timer | None = None

    def emit(self, record: logging.LogRecord) -> None:
        """Write a line, or count it."""
        self.say()
        fields = self._fields(record)
        key = key_of(record, fields)
        if key is None or self._written(key, record, fields):
            super().emit(record)

    def say(self) -> None:
        """Write the counts whose minute is over."""
        with self.lock or threading.RLock():
            now = self._clock()
            for key in [key for key, one in self._known.items() if now - one.since >= SAME_S]:
                one = self._known.pop(key)
                if one.count > MOST:
                    super().emit(_counted(one))

    def _written(self, key: Key, record: logging.LogRecord, fields: Mapping[str, object]) -> bool:
        if key not in self._known and len(self._known) >= MOST_KINDS:
            key = ("others",)
        one = self._known.get(key)
        if one is None:
            self._known[key] = _Repeated(record, fields, self._clock())
            return True
        one.count += 1
        if one.count == MOST + 1 and (self._timer is None or not self._timer.is_alive()):
            self._timer = threading.Timer(SAME_S + 1.0, self.say)  # where no other line comes
            self._timer.daemon = True
            self._timer.start()
        return one.count <= MOST


def key_of(record: logging.LogRecord, fields: Mapping[str, object]) -> Key | None:
    """What equal lines have in common: event, route, status, account and run. None for a line that is always written."""
    status = fields.get("status")
    refused = isinstance(status, int) and status >= REFUSED
    if record.levelno < logging.WARNING and not refused:
        return None
    return (record.name, record.levelno, str(record.msg), *(fields.get(name) for name in SAME))


def _counted(one: _Repeated) -> logging.LogRecord:
    """The line that stands for those that were not written."""
    first = one.first
    text = f"{one.count - MOST} more lines like this within {SAME_S:g} s: {first.getMessage()}"
    made = logging.LogRecord(first.name, first.levelno, first.pathname, first.lineno, text, None, None)
    made.__dict__["fields"] = {name: value for name, value in one.fields.items() if name in (*SAME, "request_id")}
    return made
