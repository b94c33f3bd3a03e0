"""Connections: an address that holds its share gets no more, and others still get an answer."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator

import httpx
import pytest
import uvicorn

from app import pace
from app.cli import connections
from app.config import Settings
from app.main import create_app
from tests.browser.service import free_port, until


@pytest.fixture
def port(settings: Settings) -> Iterator[int]:
    """The port of a service with the connections of `rths serve`."""
    found = free_port()
    config = uvicorn.Config(
        create_app(settings), port=found, log_level="error", timeout_graceful_shutdown=1, http=connections.Bounded
    )
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        until(lambda: server.started, bool)
        yield found
    finally:
        server.should_exit = True
        thread.join()


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=60)


def received(line: socket.socket) -> bytes:
    """Everything that comes until the service closes the connection."""
    parts = []
    while part := line.recv(65_536):
        parts.append(part)
    return b"".join(parts)


def test_an_address_gets_a_bounded_number_of_connections(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MOST_OF_ADDRESS", 3)
    held = [connected(port) for _ in range(3)]
    until(lambda: sum(map(len, connections._open.values())), lambda count: count == 3)
    with pytest.raises(httpx.TransportError):
        httpx.get(f"http://127.0.0.1:{port}/api/v1/abort", timeout=60)
    held.pop().close()
    until(lambda: answers(port), bool)
    for one in held:
        one.close()


@pytest.mark.parametrize("kind", ["application/json", "multipart/form-data; boundary=x"])
def test_a_body_of_which_nothing_comes_is_ended(port: int, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    monkeypatch.setattr(pace, "SILENT_S", 0.2)
    head = f"POST /api/v1/motions/preview HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: {kind}\r\nContent-Length: 999\r\n\r\n"
    with connected(port) as line:
        line.sendall(head.encode() + b"--x")
        answer = received(line)
    assert answer.startswith(b"HTTP/1.1 408") and b"No byte of the body came within 0.2 s" in answer


def test_the_head_of_a_later_request_has_as_long_as_the_first(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "FIRST_REQUEST_S", 0.3)
    with connected(port) as line:
        line.sendall(b"GET /livez HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        assert line.recv(65_536).startswith(b"HTTP/1.1 200")
        line.sendall(b"GET /livez HTTP/1.1\r\nHost:")  # without its end, and without the time-out of a silent connection
        assert received(line) == b""


def answers(port: int) -> bool:
    try:
        return httpx.get(f"http://127.0.0.1:{port}/api/v1/abort", timeout=60).status_code == 200
    except httpx.TransportError:
        return False
