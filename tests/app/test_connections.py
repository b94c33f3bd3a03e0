"""Connections: an address that holds its share gets no more, and others still get an answer."""

from __future__ import annotations

import socket
import threading

import httpx
import pytest
import uvicorn

from app.cli import connections
from app.config import Settings
from app.main import create_app
from tests.browser.service import free_port, until


def test_an_address_gets_a_bounded_number_of_connections(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MOST_OF_ADDRESS", 3)
    port = free_port()
    server = uvicorn.Server(
        uvicorn.Config(
            create_app(settings), port=port, log_level="error", timeout_graceful_shutdown=1, http=connections.Bounded
        )
    )
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        until(lambda: server.started, bool)
        held = [socket.create_connection(("127.0.0.1", port), timeout=60) for _ in range(3)]
        until(lambda: sum(map(len, connections._open.values())), lambda count: count == 3)
        with pytest.raises(httpx.TransportError):
            httpx.get(f"http://127.0.0.1:{port}/api/v1/abort", timeout=60)
        held.pop().close()
        until(lambda: answers(port), bool)
        for one in held:
            one.close()
    finally:
        server.should_exit = True
        thread.join()


def answers(port: int) -> bool:
    try:
        return httpx.get(f"http://127.0.0.1:{port}/api/v1/abort", timeout=60).status_code == 200
    except httpx.TransportError:
        return False
