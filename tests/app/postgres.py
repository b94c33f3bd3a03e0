"""A PostgreSQL server of its own for tests: on a free port of this machine, owned by a user that is not root."""

from __future__ import annotations

import os
import pwd
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tests.browser.service import free_port

INSTALL = "PostgreSQL is not installed (on Debian: apt-get install postgresql)"
STARTED_WITHIN_S = 60
OWNER = "postgres"  # the user that Debian's package makes


def missing() -> str | None:
    """The reason why there is no server to start; None where there is one."""
    if _programs() is None:
        return INSTALL
    return None if os.geteuid() or _owner() else f"PostgreSQL does not run as root, and there is no user '{OWNER}'"


class Server:
    """A server with an empty database, which is removed with it. It can be killed and started again."""

    def __init__(self) -> None:
        programs, self._owner = _programs(), _owner()
        assert programs is not None
        owner = self._owner
        self._user = {"user": owner, "group": pwd.getpwnam(owner).pw_gid, "extra_groups": []} if owner else {}
        self._folder = Path(tempfile.mkdtemp(prefix="rths-postgres-"))
        if owner:
            shutil.chown(self._folder, owner)
        data, name = self._folder / "data", owner or pwd.getpwuid(os.geteuid()).pw_name
        initdb = [programs / "initdb", "-D", data, "-A", "trust", "--no-sync", "-E", "UTF8", "--locale", "C"]
        subprocess.run(initdb, check=True, capture_output=True, cwd=self._folder, **self._user)  # type: ignore[call-overload]
        self.port = free_port()
        options = ["-D", data, "-p", str(self.port), "-h", "127.0.0.1", "-k", self._folder]
        self._command = [programs / "postgres", *options, "-c", "fsync=off", "-c", "max_connections=200"]
        self.url = f"postgresql://{name}@127.0.0.1:{self.port}/postgres"
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start the server and wait until it answers."""
        self._process = subprocess.Popen(  # type: ignore[call-overload]
            self._command, stderr=subprocess.DEVNULL, cwd=self._folder, **self._user
        )
        _wait(self._process, self.port)

    def kill(self) -> None:
        """Kill the server with all its processes at once, as a machine that loses its power."""
        assert self._process is not None
        main = self._process.pid
        children = [int(child) for one in Path(f"/proc/{main}/task").glob("*/children") for child in one.read_text().split()]
        for pid in (main, *children):
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self._process.wait(20)

    def remove(self) -> None:
        """Stop the server and remove its data."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
            self._process.wait(20)
        shutil.rmtree(self._folder, ignore_errors=True)


@contextmanager
def server() -> Iterator[str]:
    """The URL of an empty database, which is removed with its server."""
    one = Server()
    try:
        one.start()
        yield one.url
    finally:
        one.remove()


def _owner() -> str | None:
    """The user for a server started by root; None for another caller, or where there is no such user."""
    if os.geteuid():
        return None
    return next((one.pw_name for one in pwd.getpwall() if one.pw_name == OWNER), None)


def _programs() -> Path | None:
    """The folder with postgres and initdb: Debian's, or the one on the path."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    named = shutil.which("initdb")
    return found[-1].parent if found else Path(named).resolve().parent if named else None


def _wait(process: subprocess.Popen[bytes], port: int) -> None:
    import psycopg

    deadline = time.monotonic() + STARTED_WITHIN_S
    while True:
        assert process.poll() is None, "PostgreSQL ended at its start"
        try:
            psycopg.connect(host="127.0.0.1", port=port, user=OWNER if os.geteuid() == 0 else None, dbname="postgres").close()
            return
        except psycopg.OperationalError:
            assert time.monotonic() < deadline, "PostgreSQL did not start"
            time.sleep(0.05)
