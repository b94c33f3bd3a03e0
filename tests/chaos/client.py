"""Clients that drive tests of their own: each connects where its test waits, and again after the test was started anew."""

from __future__ import annotations

import re
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rths_engine.planning import templates
from rths_engine.wire.generic import Action, Numbers, Request, Sizes, pack_request, pack_sizes

WAITING_S, PATIENCE_S = 30.0, 10.0  # of the rig: for a client, and for its next message
SIZES = Sizes(Numbers(1, 1, 1, 0, 1), Numbers(force=1), 16)
WAITS = re.compile(r"waiting for client at (\S+):(\d+) by TCP")
STEP_S, STEP_M = 0.01, 1e-4
PAUSE_S = 0.02  # wall time that the client computes in each step


def plan(name: str) -> dict[str, Any]:
    """A test whose stations follow a client, at any free port."""
    client = {"port": 0, "waiting": WAITING_S, "patience": PATIENCE_S}
    return {**templates.template("opensees-client").as_dict(), "name": name, "client": client, "pace": {"kind": "fastest"}}


def drive(look: Callable[[], dict[str, Any]], ended: frozenset[str], steps: int) -> None:
    """Drive the test that `look` shows, whenever it waits for its client, until it has ended."""
    while (run := look())["state"] not in ended:
        waits = WAITS.fullmatch(run["doing"] or "")
        if waits:
            with suppress(OSError):  # it was killed: it has ended, or waits again at another port
                _driven((waits[1], int(waits[2])), steps)
        time.sleep(0.5)


def _driven(address: tuple[str, int], steps: int) -> None:
    with socket.create_connection(address, PATIENCE_S) as line:
        line.sendall(pack_sizes(SIZES))
        for step in range(steps):  # from rest, at 0 s
            _say(line, Action.SET_TRIAL, STEP_M * (step % 5), STEP_S * step)
            _say(line, Action.FORCE)
            if len(line.recv(8 * SIZES.size, socket.MSG_WAITALL)) < 8 * SIZES.size:
                return
            _say(line, Action.COMMIT)
            time.sleep(PAUSE_S)
        _say(line, Action.END)


def _say(line: socket.socket, action: int, displacement: float = 0.0, at: float = 0.0) -> None:
    line.sendall(pack_request(Request(action, (displacement,), (0.0,), (0.0,), at), SIZES.size))
