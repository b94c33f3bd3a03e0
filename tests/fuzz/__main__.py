"""Fuzz the REST interface: `python -m tests.fuzz --minutes N --seed S`; docs/fuzzing.md."""

from __future__ import annotations

import argparse
import logging
import sys
import tempfile
import time
from pathlib import Path

from fastapi.testclient import TestClient

from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, unpack_earlier
from tests.fuzz.api import faults, operations

EXAMPLES = 20  # of each operation and mode in a round


def main() -> int:
    """Rounds over all operations until the time is over; the faults, each once."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    logging.disable(logging.CRITICAL)
    end, seed, known = time.monotonic() + 60 * asked.minutes, asked.seed, set()
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(data=unpack_earlier(Path(folder)), embedded_worker=False, local_sign_in=True)
        with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
            while time.monotonic() < end:
                for operation in operations(client.app):  # type: ignore[arg-type]
                    for fault in faults(client, operation, EXAMPLES, seed):
                        kind = f"{operation.label} {fault.partition(':')[0]}"
                        if kind not in known:
                            known.add(kind)
                            print(f"seed {seed}: {operation.label}: {fault}", flush=True)
                    if time.monotonic() > end:
                        break
                seed += 1
    print(f"{seed - asked.seed} rounds, {len(known)} kinds of fault")
    return min(1, len(known))


if __name__ == "__main__":
    sys.exit(main())
