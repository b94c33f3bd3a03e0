"""Logs: one event on each line, as text or JSON, with the request and the run that it is about, and without secrets."""

from __future__ import annotations

import json
import logging
import os
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime

from app.repeats import Bounded

TEXT, JSON = "text", "json"
FORMATS = (TEXT, JSON)
LEVELS = ("debug", "info", "warning", "error")
FORMAT_KEY, LEVEL_KEY = "RTHS_LOG_FORMAT", "RTHS_LOG_LEVEL"
CONTEXT = ("request_id", "run", "worker", "account")
"""What a line may be about, in the order in which it is written."""
OWN_HANDLERS = ("dbos",)  # loggers of libraries that write by themselves unless they have a handler
TALKATIVE = ("dbos", "httpx", "httpcore", "numba", "websockets", "alembic.runtime.plugins")  # tell each step of theirs
HIDDEN = "[hidden]"
_SECRETS = (
    re.compile(r"(?<=://)[^\s/@:]*:[^\s/@]+(?=@)"),  # user and password in a URL
    re.compile(r"(?i)(?<=bearer )[^\s,;'\"]+"),
    re.compile(r"(?i)(?<=\btoken=)[^\s&;'\"]+|(?<=\bsecret=)[^\s&;'\"]+|(?<=\bpassword=)[^\s&;'\"]+"),
)
_about: ContextVar[Mapping[str, str]] = ContextVar("about", default={})  # noqa: B039 (never changed in place)
_always: dict[str, str] = {}


@contextmanager
def about(**names: str) -> Iterator[None]:
    """Write these names (of CONTEXT) with every line of this thread or task meanwhile."""
    token = _about.set({**_about.get(), **names})
    try:
        yield
    finally:
        _about.reset(token)


def configure(form: str, level: str, **always: str) -> None:
    """Write the events of this program and of its libraries to standard error; `always` names stand on every line.

    Refusals and warnings that repeat are counted instead: app/repeats.py.

    Processes that this process starts write likewise: they call `inherit`.
    """
    _always.update(always)
    os.environ.update({FORMAT_KEY: form, LEVEL_KEY: level})
    handler = Bounded(sys.stderr, fields)
    handler.setFormatter(JsonLines() if form == JSON else TextLines())
    logging.root.handlers[:] = [handler]
    logging.root.setLevel(level.upper())
    for name in OWN_HANDLERS:
        library = logging.getLogger(name)
        library.handlers[:], library.propagate = [handler], False
        library.setLevel(level.upper())
    for name in ("uvicorn", "uvicorn.error", "uvicorn.access", "alembic"):
        library = logging.getLogger(name)
        library.handlers.clear()
        library.propagate, library.disabled = True, False
    if level != "debug":
        for name in TALKATIVE:
            logging.getLogger(name).setLevel(max(logging.WARNING, logging.getLevelName(level.upper())))


def inherit(**always: str) -> None:
    """Write as the process that started this one does."""
    configure(os.environ.get(FORMAT_KEY, TEXT), os.environ.get(LEVEL_KEY, "warning"), **always)


def fields(record: logging.LogRecord) -> dict[str, str]:
    """What a line is about: names of CONTEXT, and what the caller gave as `extra={"fields": ...}`."""
    known = {**_always, **_about.get()}
    return {name: known[name] for name in CONTEXT if name in known} | getattr(record, "fields", {})


def without_secrets(text: str) -> str:
    """The text without passwords and tokens."""
    for pattern in _SECRETS:
        text = pattern.sub(HIDDEN, text)
    return text


class JsonLines(logging.Formatter):
    """One JSON object on each line."""

    def format(self, record: logging.LogRecord) -> str:
        line: dict[str, object] = {
            "time": _time(record),
            "level": record.levelname.lower(),
            "event": without_secrets(record.getMessage()),
            "logger": record.name,
            **fields(record),
        }
        if record.exc_info:
            line["error"] = without_secrets(self.formatException(record.exc_info))
        return json.dumps(line, default=str)


class TextLines(logging.Formatter):
    """Time, level, event and fields on one line; the trace of an error on the lines below it, indented."""

    def format(self, record: logging.LogRecord) -> str:
        named = "".join(f" {name}={value}" for name, value in fields(record).items())
        event = without_secrets(record.getMessage()).replace("\r", "\\r").replace("\n", "\\n")
        line = f"{_time(record)} {record.levelname.lower()} {record.name}: {event}{named}"
        if record.exc_info:
            line += "\n    " + without_secrets(self.formatException(record.exc_info)).replace("\n", "\n    ")
        return line


def _time(record: logging.LogRecord) -> str:
    return datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
