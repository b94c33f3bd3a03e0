"""A viewer that stops reading and does not close: it loses its connection, what waits for it is bounded, and others go on."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest
import uvicorn
from websockets.sync.client import ClientConnection, connect

from app.cli import connections
from app.cli.serve import listen
from app.config import Settings
from app.live import frames
from app.live.frames import HEADER, end_of
from app.live.messages import schema
from app.live.uplink import FRAME_HEADER
from app.main import create_app
from app.metrics import REGISTRY
from rths_engine.results.channels import Channel
from tests.browser.service import free_port, until

RUN = "0" * 36
CHANNELS = tuple(Channel("x_cmd", 1, str(number)) for number in range(64))
BUCKETS = 4096  # 3 MB, more than the systems of both ends take for a viewer that does not read
SMALL = 16_384  # bytes, of the buffers of both systems
PIECE = 1 << 17


@dataclass
class Web:
    """The service with the connections of `rths serve`, and the worker of one run."""

    port: int
    worker: ClientConnection

    def show(self, first: int, end: int) -> None:
        """Tell of the buckets from `first` to `end`."""
        values = np.zeros((end - first, len(CHANNELS), 3), "<f4")
        head = FRAME_HEADER.pack(RUN.encode(), 1) + HEADER.pack(first, end - first)
        self.worker.send(head + values.tobytes())

    def viewer(self, first: int) -> ClientConnection:
        return connect(f"ws://127.0.0.1:{self.port}/api/v1/runs/{RUN}/live?from={first}")

    def viewer_that_stops(self) -> socket.socket:
        """A viewer that asks for everything and reads nothing."""
        line = socket.socket()
        line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALL)
        line.connect(("127.0.0.1", self.port))
        head = [
            f"GET /api/v1/runs/{RUN}/live HTTP/1.1",
            f"Host: 127.0.0.1:{self.port}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            "Sec-WebSocket-Version: 13",
            "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==",
        ]
        line.sendall("\r\n".join([*head, "", ""]).encode())
        return line


@pytest.fixture
def web(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Iterator[Web]:
    monkeypatch.setattr(connections, "TAKES_S", 1.0)
    monkeypatch.setattr(frames, "PIECE", PIECE)
    settings = replace(settings, port=free_port())
    listening = listen(settings)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SMALL)
    config = uvicorn.Config(create_app(settings), log_level="error", timeout_graceful_shutdown=1, http=connections.Bounded)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, args=([listening],))
    thread.start()
    try:
        until(lambda: server.started, bool)
        token = {"Authorization": f"Bearer {settings.worker_token}"}
        with connect(f"ws://127.0.0.1:{settings.port}/api/v1/worker", additional_headers=token) as worker:
            told = {"run_id": RUN, "attempt": 1, "message": schema(1, 1e-3, 1, BUCKETS, CHANNELS)}
            worker.send(json.dumps(told))
            yield Web(settings.port, worker)
    finally:
        server.should_exit = True
        thread.join()


def viewers() -> float:
    return REGISTRY.get_sample_value("rths_websockets", {"side": "viewer"}) or 0.0


def waiting() -> int:
    """Bytes that wait in the service for the client that reads slowest."""
    return max((one.get_write_buffer_size() for held in connections._open.values() for one in list(held)), default=0)


def reach(viewer: ClientConnection, bucket: int) -> None:
    """Receive until a frame ends at `bucket`."""
    while True:
        message = viewer.recv(timeout=60)
        if isinstance(message, bytes) and end_of(message) == bucket:
            return


def test_a_viewer_that_stops_reading_loses_its_connection_and_disturbs_nobody(web: Web) -> None:
    before, last = viewers(), BUCKETS - 10
    web.show(0, last - 1)
    with web.viewer(last - 1) as other:
        web.show(last - 1, last)
        reach(other, last)
        with web.viewer_that_stops() as stopped:
            most = until(waiting, bool)
            for bucket in range(last, BUCKETS):
                web.show(bucket, bucket + 1)
                reach(other, bucket + 1)  # also while the service holds what the one that stopped does not take
                most = max(most, waiting())
            until(viewers, lambda count: count == before + 1)
            until(waiting, lambda size: size == 0)
            assert most < 2 * PIECE
            assert stopped.recv(1)  # what its system took before: this end was never closed
        web.show(0, BUCKETS)  # a worker that connects again tells everything anew
    with web.viewer(0) as whole:
        reach(whole, BUCKETS)
