"""A soft IOC with a spring behind a command, for tests: `python -m tests.engine.soft_ioc PREFIX`, in a process of its own.

    PREFIX:CMD    command, mm, limits ±50      PREFIX:X, PREFIX:F   displacement, mm, and force, kN: 2 kN/mm
    PREFIX:BEAT   heartbeat                    PREFIX:ECHO          the heartbeat that the readings belong to
    PREFIX:PERMIT 1 while the rig permits      PREFIX:FEET          a displacement in ft

A line `FAULT STEP` on standard input makes the rig fail at this step: none, invalid, withdraw, silent or end.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Self

NAMES = {"command": "RIG:CMD", "displacement": "RIG:X", "force": "RIG:F"}
PROVEN = {"permit": "RIG:PERMIT", "heartbeat": "RIG:BEAT", "echo": "RIG:ECHO"}
LOCAL = ("EPICS_CA_ADDR_LIST", "EPICS_CAS_INTF_ADDR_LIST", "EPICS_CAS_BEACON_ADDR_LIST", "EPICS_PVAS_INTF_ADDR_LIST")


class Ioc:
    """The process of the IOC with the prefix RIG. `fails` plans a fault, and puts the spring back to zero."""

    def __init__(self) -> None:
        command = [sys.executable, "-m", "tests.engine.soft_ioc", "RIG"]
        root, pipe = Path(__file__).parents[2], subprocess.PIPE
        self.process = subprocess.Popen(command, cwd=root, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, text=True)
        self._heard("ready")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.communicate()

    def fails(self, fault: str = "none", step: int = 0) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(f"{fault} {step}\n")
        self.process.stdin.flush()
        self._heard("planned")

    def _heard(self, word: str) -> None:
        assert self.process.stdout is not None
        assert any(line.strip() == word for line in self.process.stdout), "the soft IOC has ended"


@contextmanager
def alone() -> Iterator[None]:
    """Channel Access on this machine only, at free ports. It reads the environment once in the life of a process."""
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    server, repeater = (str(one.getsockname()[1]) for one in sockets)
    for one in sockets:
        one.close()
    names = {**dict.fromkeys(LOCAL, "127.0.0.1"), "EPICS_CA_AUTO_ADDR_LIST": "NO"}
    names |= {"EPICS_CA_SERVER_PORT": server, "EPICS_CA_REPEATER_PORT": repeater}
    before = {name: os.environ.get(name) for name in names}
    os.environ.update(names)
    yield
    for name, value in before.items():
        os.environ.pop(name) if value is None else os.environ.update({name: value})


def main(prefix: str) -> None:
    from softioc import alarm, asyncio_dispatcher, builder, softioc

    dispatcher = asyncio_dispatcher.AsyncioDispatcher()
    builder.SetDeviceName(prefix)
    x = builder.aIn("X", initial_value=0.0, EGU="mm", PREC=9)
    f = builder.aIn("F", initial_value=0.0, EGU="kN", PREC=9)
    builder.aIn("FEET", initial_value=0.0, EGU="ft")
    echo = builder.longIn("ECHO", initial_value=0)
    permit = builder.boolOut("PERMIT", "No", "Yes", initial_value=True, always_update=True)
    now: dict[str, float] = {"x": 0.0}
    planned: tuple[str, int] = ("none", 0)

    def moved(value: float) -> None:
        now["x"] = value

    def beaten(step: int) -> None:
        fault = planned[0] if step >= planned[1] else "none"
        if fault == "end":
            os._exit(0)
        if fault == "silent":
            return
        x.set(now["x"])
        f.set(2.0 * now["x"], severity=alarm.INVALID_ALARM if fault == "invalid" else alarm.NO_ALARM)
        if fault == "withdraw":
            permit.set(False)
        echo.set(step)

    builder.aOut("CMD", initial_value=0.0, EGU="mm", DRVH=50, DRVL=-50, PREC=9, on_update=moved, always_update=True)
    builder.longOut("BEAT", initial_value=0, on_update=beaten, always_update=True)
    builder.LoadDatabase()
    softioc.iocInit(dispatcher)
    print("ready", flush=True)
    for line in sys.stdin:
        fault, step = line.split()
        planned = (fault, int(step))
        now["x"] = 0.0
        x.set(0.0)
        f.set(0.0)
        permit.set(fault != "forbid")
        print("planned", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
