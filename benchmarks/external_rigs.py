"""`python -m benchmarks.external_rigs`: times of an exchange with each kind of external rig, all on this machine."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.parts.connections.connection import External, Terms
from rths_engine.parts.connections.epics import Epics
from rths_engine.parts.connections.fmu import Fmu
from rths_engine.parts.connections.generic_client import GenericClient
from tests.engine.built_fmu import build
from tests.engine.generic_server import serving
from tests.engine.soft_ioc import NAMES, PROVEN, Ioc, alone

STEPS = 4000
TERMS = Terms("stations.0.connection", 1 / 1024, 0.03, 1e6)


def main() -> None:
    """Measure and print all exchanges."""
    for transport in ("tcp", "udp"):
        with serving(2.0, udp=transport == "udp") as server:
            _measure(
                f"generic, {transport.upper()}", GenericClient.model_validate({"port": server.port, "transport": transport})
            )
    with alone(), Ioc() as ioc:
        for reading in ("get", "monitor"):
            for names in (PROVEN, {}):
                ioc.fails()
                proof = "with echo" if names else "without echo"
                _measure(
                    f"EPICS, {reading}, {proof}", Epics.model_validate({**NAMES, **names, "reading": reading, "patience": 10.0})
                )
    with tempfile.TemporaryDirectory() as folder:
        for version in (3, 2):
            path = build(Path(folder), version)
            _measure(f"FMU, FMI {version}.0", Fmu.model_validate({"path": str(path), "displacement": "displacement"}))


def _measure(name: str, connection: External) -> None:
    adapter: Any = connection.adapter(TERMS)
    adapter.open()
    taken = np.empty(STEPS)
    for step in range(STEPS):
        begun = time.perf_counter()
        adapter.command(1e-3 * np.sin(1e-2 * step), 0.0, step * TERMS.dt)
        adapter.measure()
        taken[step] = time.perf_counter() - begun
    adapter.close()
    median, tail, worst = 1e6 * np.array([np.median(taken), np.quantile(taken, 0.99), taken.max()])
    late = 100 * np.mean(taken > TERMS.dt)
    print(
        f"{name:30} median {median:6.0f} us   99 % {tail:6.0f} us   worst {worst:7.0f} us   over 1/1024 s {late:5.1f} %",
        flush=True,
    )


if __name__ == "__main__":
    main()
