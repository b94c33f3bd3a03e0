"""Fuzz REST interface, readers, plans and websockets: `python -m tests.fuzz --minutes N --seed S`; docs/fuzzing.md."""

from __future__ import annotations

import argparse
import logging
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from pathlib import Path

from fastapi.testclient import TestClient

from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, unpack_earlier
from tests.fuzz import api, plans, readers, sockets

EXAMPLES = {"api": 20, "readers": 100, "plans": 300, "sockets": 100}  # of each operation and mode, reader or socket in a round
Faults = Iterator[tuple[str, Iterator[str]]]


def main() -> int:
    """Rounds over all parts until the time is over; the faults, each once."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=list(EXAMPLES), action="append", help="one part; may be given several times")
    asked = parser.parse_args()
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore", RuntimeWarning)
    end, seed, known = time.monotonic() + 60 * asked.minutes, asked.seed, set()
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(data=unpack_earlier(Path(folder)), embedded_worker=False, local_sign_in=True)
        with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
            while time.monotonic() < end:
                for name, faults in _round(client, asked.only or list(EXAMPLES), seed):
                    for fault in faults:
                        kind = f"{name} {fault.partition(':')[0]}"
                        if kind not in known:
                            known.add(kind)
                            print(f"seed {seed}: {name}: {fault}", flush=True)
                    if time.monotonic() > end:
                        break
                seed += 1
    print(f"{seed - asked.seed} rounds, {len(known)} kinds of fault")
    return min(1, len(known))


def _round(client: TestClient, parts: list[str], seed: int) -> Faults:
    """Each thing that is fuzzed in a round, with its faults."""
    if "readers" in parts:
        for name in readers.READERS:
            yield f"reader of {name}", readers.faults(name, EXAMPLES["readers"], seed)
    if "plans" in parts:
        yield "plans", plans.faults(EXAMPLES["plans"], seed)
    if "sockets" in parts:
        yield "websockets", sockets.faults(client, EXAMPLES["sockets"], seed)
    if "api" in parts:
        for operation in api.operations(client.app):  # type: ignore[arg-type]
            yield operation.label, api.faults(client, operation, EXAMPLES["api"], seed)


if __name__ == "__main__":
    sys.exit(main())
