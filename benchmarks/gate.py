"""Time that the gate adds to a request: `python -m benchmarks.gate`. Processor time, so that other programs do not count."""

from __future__ import annotations

import asyncio
import tempfile
import time
from pathlib import Path
from typing import Any

from app.access import Role
from app.accounts.credentials import Credentials
from app.accounts.service import AccountService
from app.accounts.signing_in import SigningIn
from app.config import Settings
from app.db import connect, migrate, sessions, unit_of_work
from app.gate import Gate, cookie_name
from app.main import create_app

REQUESTS = 5000


class _Behind:
    """The application behind the gate. It counts the requests that are let through."""

    passed = 0

    async def __call__(self, *_: Any) -> None:
        self.passed += 1


async def _nothing(*_: Any) -> None:
    """Nothing to receive or to send."""


async def _mean_us(gate: Any, scope: dict[str, Any], different: bool) -> float:
    begun = time.process_time()
    for number in range(REQUESTS):
        path = f"/nowhere/{number if different else 1}"  # matches the last route of all
        await gate({**scope, "path": path, "raw_path": path.encode()}, _nothing, _nothing)
    return (time.process_time() - begun) / REQUESTS * 1e6


def main() -> None:
    """Print the time of a request through the gate, with its address seen before and with a new address each time."""
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(data=Path(folder), embedded_worker=False).prepared()
        migrate(settings.url)
        engine = connect(settings.url)
        app = create_app(settings)
        app.state.credentials = Credentials(sessions(engine), app.state.sockets)
        with unit_of_work(sessions(engine)) as session:
            account = AccountService(session).add("Ana Ruiz", Role.VIEWER, "three long words")
            key, _ = SigningIn(session).start(account, "127.0.0.1", "benchmark")
        headers = [(b"host", b"127.0.0.1:8000"), (b"cookie", f"{cookie_name(settings)}={key}".encode())]
        scope = {
            "type": "http",
            "method": "GET",
            "query_string": b"",
            "headers": headers,
            "client": ("127.0.0.1", 1),
            "app": app,
        }
        behind = _Behind()
        gate = Gate(behind, settings)
        for words, different in (("an address seen before", False), ("a new address each time", True)):
            asyncio.run(_mean_us(gate, scope, False))
            print(f"{words:<26}{asyncio.run(_mean_us(gate, scope, different)):6.1f} µs")
        if behind.passed != 4 * REQUESTS:
            raise SystemExit(f"the gate refused {4 * REQUESTS - behind.passed} requests")
        app.state.credentials.close()
        engine.dispose()


if __name__ == "__main__":
    main()
