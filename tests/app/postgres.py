"""A PostgreSQL server of its own for tests: on a free port of this machine, owned by a user that is not root."""

from __future__ import annotations

import os
import pwd
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
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


@contextmanager
def server() -> Iterator[str]:
    """The URL of an empty database, which is removed with its server."""
    programs, owner = _programs(), _owner()
    assert programs is not None
    user = {"user": owner, "group": pwd.getpwnam(owner).pw_gid, "extra_groups": []} if owner else {}
    folder = Path(tempfile.mkdtemp(prefix="rths-postgres-"))
    try:
        if owner:
            shutil.chown(folder, owner)
        data, name = folder / "data", owner or pwd.getpwuid(os.geteuid()).pw_name
        initdb = [programs / "initdb", "-D", data, "-A", "trust", "--no-sync", "-E", "UTF8", "--locale", "C"]
        subprocess.run(initdb, check=True, capture_output=True, cwd=folder, **user)  # type: ignore[call-overload]
        port = free_port()
        options = ["-D", data, "-p", str(port), "-h", "127.0.0.1", "-k", folder, "-c", "fsync=off", "-c", "max_connections=200"]
        process = subprocess.Popen([programs / "postgres", *options], stderr=subprocess.DEVNULL, cwd=folder, **user)  # type: ignore[call-overload]
        try:
            _wait(process, port)
            yield f"postgresql://{name}@127.0.0.1:{port}/postgres"
        finally:
            process.terminate()
            process.wait(20)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


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
