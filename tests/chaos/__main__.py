"""`make chaos`: kill, fill, cut and turn back everything under running tests, and print what became of them."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from tests.app import postgres
from tests.chaos.running import chaos

STORES = ("sqlite", "postgresql")


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.chaos", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=200, help="short tests, beside one sweep (default %(default)s)")
    parser.add_argument("--faults", type=int, help="faults at least (default: one for every eight tests)")
    parser.add_argument("--store", choices=[*STORES, "both"], default="both")
    parser.add_argument("--log", type=Path, help="folder for what the processes say (default: a temporary folder)")
    given = parser.parse_args()
    folder = given.log or Path(tempfile.mkdtemp(prefix="rths-chaos-log-"))
    folder.mkdir(parents=True, exist_ok=True)
    broken = 0
    for store in STORES if given.store == "both" else (given.store,):
        missing = postgres.missing() if store == "postgresql" else None
        if missing:
            print(f"Chaos on {store}: not run. {missing}.")
            continue
        log = folder / f"{store}-{given.seed}.log"
        faults = given.faults if given.faults is not None else -(-given.runs // 8)
        report = chaos(store, given.seed, given.runs, faults, log)
        print(f"{report.text()}\nLog: {log}\n", flush=True)
        broken += len(report.wrong)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
