"""When a report was made, and by which software."""

from __future__ import annotations

import platform
from datetime import UTC, datetime

from rths_engine import __version__


def made() -> str:
    """The sentence at the end of a report."""
    now = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    return f"Report made {now} by RTHS control room {__version__}, Python {platform.python_version()}"
