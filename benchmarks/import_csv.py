"""Import of a large CSV file beside pyarrow and polars that only read it: speed and peak memory, one process for each.

`python -m benchmarks.import_csv [MB ...]` measures alone; pyarrow and polars come with `pip install '.[bench]'`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.foundation import files
from rths_engine.recordings import measured

SIZES_MB = (250, 1000)
REPEATS = 3  # the fastest counts: other work of the machine only slows a run
STATIONS = 6  # of three channels each, and the ground's acceleration
RATE = 1024  # Hz
PART = 20_000  # rows


def import_csv(sizes: tuple[int, ...] = SIZES_MB) -> dict[str, Any]:
    """Seconds, MB/s, processor seconds and peak memory of each reader for each size, and the ratios of speeds."""
    found: dict[str, Any] = {}
    with tempfile.TemporaryDirectory(prefix="rths-bench-") as folder:
        for size in sizes:
            path = Path(folder) / f"{size}.csv"
            make(path, size * 1_000_000)
            runs: dict[str, list[dict[str, float]]] = {which: [] for which in READERS if _present(which)}
            for _ in range(REPEATS):
                for which, each in runs.items():
                    each.append(_apart(which, path))
            best = {which: min(each, key=lambda one: float(one["s"])) for which, each in runs.items()}
            peers = [best[which]["s"] for which in ("pyarrow", "polars") if which in best]
            ratios = {f"{which}_ratio": round(min(peers) / best[which]["s"], 2) for which in OURS if peers}
            found[f"{size}_mb"] = best | ratios
            path.unlink()
    return {"import_csv": found}


def make(path: Path, size: int) -> None:
    """Write a file of at least `size` bytes: a header, and rows of time and 19 signals with about nine characters each."""
    names = [f"{name} {k}" for k in range(1, STATIONS + 1) for name in ("command (mm)", "displacement (mm)", "force (kN)")]
    rng, row = np.random.default_rng(1), 0
    form = ",".join(["%.6f"] + ["%.6f"] * len(names) + ["%.7f"])
    with path.open("w") as file:
        file.write(",".join(["time (s)", *names, "ground (g)"]) + "\n")
        while file.tell() < size:
            t = np.arange(row, row + PART) / RATE
            columns = [t]
            for k in range(STATIONS):
                x = 20 * np.sin(2 * np.pi * (0.7 + 0.1 * k) * t)
                columns += [x, x + 0.01 * rng.standard_normal(PART), 3 * x + 0.1 * rng.standard_normal(PART)]
            columns.append(0.3 * rng.standard_normal(PART))
            file.write("\n".join(form % one for one in zip(*columns, strict=True)) + "\n")
            row += PART


def mapping(table: measured.Table) -> measured.Mapping:
    """The mapping of the columns of `make`."""
    roles = (("x_cmd", "mm"), ("x_meas", "mm"), ("f_meas", "kN"))
    names = [one.name for one in table.columns]
    stations = [
        {"column": name, "role": roles[k % 3][0], "unit": roles[k % 3][1], "number": k // 3 + 1}
        for k, name in enumerate(names[1:-1])
    ]
    ends = [{"column": names[0], "role": "t", "unit": "s"}, {"column": names[-1], "role": "ag", "unit": "g"}]
    return measured.Mapping.read({"schema": "rths-mapping/1", "channels": [*ends, *stations]})


def _read(path: Path) -> None:
    measured.read(path, path.name)


def _import(path: Path, durable: bool = False) -> None:
    table = measured.read(path, path.name)
    recording = measured.imported(table, mapping(table), path.name, "")
    measured.save(path.with_suffix(".h5"), recording, durable=durable)


def _checksum_too(path: Path) -> None:
    with ThreadPoolExecutor(1) as pool:  # as `rths import` does
        checksum = pool.submit(files.checksum, path)
        _import(path)
        checksum.result()


def _to_the_disk(path: Path) -> None:
    _import(path, durable=True)


def _pyarrow(path: Path) -> None:
    import pyarrow.csv

    pyarrow.csv.read_csv(path)


def _polars(path: Path) -> None:
    import polars

    polars.read_csv(path)


READERS: dict[str, Callable[[Path], None]] = {
    "pyarrow": _pyarrow,
    "polars": _polars,
    "read": _read,
    "import": _import,
    "import_and_checksum": _checksum_too,
    "import_to_the_disk": _to_the_disk,
}
OURS = ("read", "import", "import_and_checksum", "import_to_the_disk")


def _present(which: str) -> bool:
    return which in OURS or find_spec(which) is not None


def _apart(which: str, path: Path) -> dict[str, float]:
    """One run in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.import_csv", which, str(path)]
    found: dict[str, float] = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    path.with_suffix(".h5").unlink(missing_ok=True)
    os.sync()  # what one run has left to be written must not slow the next
    return found


def _measured(which: str, path: Path) -> dict[str, float]:
    small = path.with_name("small.csv")
    small.write_text("time (s),x (mm)\n" + "".join(f"{k},{k}\n" for k in range(10)))
    (READERS[which] if which not in OURS else _read)(small)  # imports modules and machine code
    held, processor, start = _peak_mb(), time.process_time(), time.perf_counter()
    READERS[which](path)
    wall, processor = time.perf_counter() - start, time.process_time() - processor
    speed = path.stat().st_size / 1e6 / wall
    found = {"s": wall, "mb_per_s": speed, "processor_s": processor, "peak_mb": _peak_mb(), "peak_mb_before": held}
    return {name: round(value, 2 if value < 100 else 0) for name, value in found.items()}


def _peak_mb() -> float:
    """Peak of the memory of this process; `ru_maxrss` would include that of the process that started it."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1e3


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in READERS:
        print(json.dumps(_measured(sys.argv[1], Path(sys.argv[2]))))
    else:
        print(json.dumps(import_csv(tuple(map(int, sys.argv[1:])) or SIZES_MB), indent=2))
