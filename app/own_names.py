"""Names and addresses under which this computer may be asked: docs/decisions/0078."""

from __future__ import annotations

import ipaddress
import socket
from concurrent.futures import Future
from functools import cache
from threading import Thread

PATIENCE_S = 2.0  # for the name service, which a laboratory without a network does not reach


@cache
def own_names() -> frozenset[str]:
    """The name of this computer: as it stands, its first word, that in a local network without a name service, and in full."""
    name = socket.gethostname().lower()
    word = name.partition(".")[0]
    return frozenset(filter(None, {name, word, f"{word}.local" if word else "", _in_full()}))


def is_address(host: str | None) -> bool:
    """Whether a host is an IP address, version 4 or 6."""
    try:
        ipaddress.ip_address(host or "")
    except ValueError:
        return False
    return True


def _in_full() -> str:
    """The name with its domain; empty where the name service does not answer in time."""
    found: Future[str] = Future()
    Thread(target=lambda: found.set_result(socket.getfqdn().lower()), daemon=True, name="rths-own-name").start()
    try:
        return found.result(PATIENCE_S)
    except TimeoutError:
        return ""
