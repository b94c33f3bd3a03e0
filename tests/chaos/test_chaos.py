"""A short chaos run: two dozen faults would take minutes, so this has one of each kind that matters most, with a fixed seed."""

from __future__ import annotations

import random
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import cast

import httpx
import pytest

from tests.app import postgres
from tests.chaos.load import Load
from tests.chaos.proxy import Proxy
from tests.chaos.running import LONGEST_GAP_S, Progress, Report, _wait, chaos
from tests.chaos.world import World


@pytest.mark.slow
@pytest.mark.parametrize("store", ["sqlite", "postgresql"])
def test_no_run_is_lost_or_doubled_while_everything_under_it_is_killed(store: str, tmp_path: Path) -> None:
    reason = postgres.missing() if store == "postgresql" else None
    if reason:
        pytest.skip(reason)
    report = chaos(store, 3, 12, 6, tmp_path / "log")
    assert not report.wrong, report.text()


def test_the_next_fault_does_not_wait_once_everything_has_ended() -> None:
    progress = Progress("http://127.0.0.1", Load("http://127.0.0.1", 3, random.Random(1)))  # the load has submitted everything
    progress.http = httpx.Client(
        base_url="http://lab", transport=httpx.MockTransport(lambda _: httpx.Response(200, json={"total": 3}))
    )
    begun = time.monotonic()
    _wait(cast("World", None), Report("sqlite", 1, 3), progress, more=1)
    assert progress.over and time.monotonic() - begun < LONGEST_GAP_S / 2


def test_a_cut_network_holds_or_resets_connections_and_is_mended() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        threading.Thread(target=_echo, args=(server,), daemon=True).start()
        proxy = Proxy(server.getsockname()[1])

        def ask() -> socket.socket:
            found = socket.create_connection(("127.0.0.1", proxy.port), 20)
            found.sendall(b"hello")
            return found

        with ask() as one:
            assert one.recv(9) == b"hello"
        proxy.cut(silently=True)
        with ask() as one:
            one.settimeout(0.2)
            with pytest.raises(TimeoutError):
                one.recv(9)
            proxy.mend()
            one.settimeout(20)
            assert one.recv(9) == b"hello"
        proxy.cut(silently=False)
        with socket.create_connection(("127.0.0.1", proxy.port), 20) as one:
            assert one.recv(9) == b""
        proxy.close()


def _echo(server: socket.socket) -> None:
    """Answer every connection with what it sends first."""
    while True:
        try:
            one, _ = server.accept()
        except OSError:
            return
        threading.Thread(target=_answer, args=(one,), daemon=True).start()


def _answer(one: socket.socket) -> None:
    with one, suppress(OSError):
        one.sendall(one.recv(9))
        one.recv(9)
