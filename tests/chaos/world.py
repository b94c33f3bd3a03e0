"""The world of a chaos run: a database, a web service and two workers in processes of their own, on a disk that can be full."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from tests.app import postgres
from tests.browser.service import ROOT, UNMEASURED, free_port
from tests.chaos.clock import Clock, library
from tests.chaos.proxy import Proxy

DISK = (
    512  # MB of the disk for recordings, and for the database where it is SQLite: 200 tests beside the reserve of the service
)
NAMES = ("lab-1", "lab-2")


class World:
    """Everything that a chaos run can break. Each part can be started again; `close` ends all and removes the data."""

    def __init__(self, store: str, log: Path):
        self.store, self.log = store, log
        self.folder = Path(tempfile.mkdtemp(prefix="rths-chaos-"))
        self.small_disk = _mount(self.folder)
        self.data = self.folder / "data"
        self.data.mkdir()
        self.apart = Path(tempfile.mkdtemp(prefix="rths-chaos-clocks-"))
        self.clock_library = library(self.apart)
        self.clocks = {name: Clock(self.apart / name) for name in ("web", *NAMES)}
        self.database = postgres.Server() if store == "postgresql" else None
        if self.database is not None:
            self.database.start()
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.networks = {name: self._network() for name in NAMES}
        self.web: subprocess.Popen[bytes] | None = None
        self.workers: dict[str, subprocess.Popen[bytes]] = {}

    def start_web(self) -> None:
        self.web = self._start("web", ["-m", "tests.chaos.web", str(self.data), str(self.port)], self._url(None))

    def start_worker(self, name: str) -> None:
        web = f"ws://127.0.0.1:{self.networks[name][0].port}"
        options = ["--data", str(self.data), "--web", web, "--name", name, "--workers", "1"]
        self.workers[name] = self._start(name, ["-m", "app.worker", *options], self._url(name))

    def engines(self, name: str) -> list[int]:
        """The processes of a worker that execute tests and sweeps."""
        main = self.workers[name].pid
        return [pid for pid in _children(main) if "spawn_main" in _command(pid)]

    def fill(self) -> Path:
        """Fill the small disk; the file that fills it."""
        filler = self.folder / "filler"
        with filler.open("wb") as file, suppress(OSError):
            while True:
                file.write(b"\0" * (1 << 20))
                file.flush()
        with filler.open("ab", buffering=0) as file, suppress(OSError):
            while True:
                file.write(b"\0" * 512)
        return filler

    def close(self) -> None:
        for process in (self.web, *self.workers.values()):
            if process is not None:
                process.kill()
                process.wait(20)
        for proxy in (proxy for pair in self.networks.values() for proxy in pair):
            proxy.close()
        if self.database is not None:
            self.database.remove()
        if self.small_disk:
            for _ in range(50):  # until the engines have heard that their workers are gone
                if subprocess.run(["umount", self.folder], capture_output=True, check=False).returncode == 0:
                    break
                time.sleep(0.1)
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.rmtree(self.apart, ignore_errors=True)

    def _network(self) -> list[Proxy]:
        """The networks of a worker: to the web service and, where there is one, to the database server."""
        return [Proxy(self.port), *([Proxy(self.database.port)] if self.database is not None else [])]

    def _url(self, name: str | None) -> str:
        if self.database is None:
            return ""
        port = self.database.port if name is None else self.networks[name][1].port
        return self.database.url.replace(f":{self.database.port}/", f":{port}/")

    def _start(self, name: str, arguments: list[str], database: str) -> subprocess.Popen[bytes]:
        environment = {
            **UNMEASURED,
            "RTHS_DATABASE_URL": database,
            "RTHS_WORKER_TOKEN": "chaos",
            "RTHS_SWEEP_PROCESSES": "1",
            **(self.clocks[name].environment(self.clock_library) if self.clock_library else {}),
        }
        with self.log.open("ab") as log:
            return subprocess.Popen([sys.executable, *arguments], cwd=ROOT, env=environment, stdout=log, stderr=log)


def ended(process: subprocess.Popen[bytes] | None) -> bool:
    return process is None or process.poll() is not None


def killed(process: subprocess.Popen[bytes] | None) -> None:
    if process is not None:
        with suppress(ProcessLookupError):
            process.send_signal(signal.SIGCONT)
            process.kill()
        process.wait(20)


def _mount(folder: Path) -> bool:
    """Give the folder a small disk of its own, where this user may."""
    if os.geteuid():
        return False
    options = ["-t", "tmpfs", "-o", f"size={DISK}m", "tmpfs", str(folder)]
    return subprocess.run(["mount", *options], capture_output=True, check=False).returncode == 0


def _children(pid: int) -> Iterator[int]:
    with suppress(OSError):
        for thread in Path(f"/proc/{pid}/task").glob("*/children"):
            yield from (int(child) for child in thread.read_text().split())


def _command(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode()
    except OSError:
        return ""
