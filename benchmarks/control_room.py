"""The control room as a laboratory runs it, `rths serve --local`, in processes of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx

from tests.browser.service import STARTED_WITHIN_S, Service, free_port, until


@contextmanager
def control_room(folder: Path, database: str = "", **environment: str) -> Iterator[Service]:
    """A control room with its data in a folder, on SQLite there or on the database of a URL. Its log lies beside the folder."""
    port = free_port()
    command = [str(Path(sys.executable).with_name("rths")), "serve", "--local", "--data", str(folder), "--port", str(port)]
    given = {**os.environ, "RTHS_DATABASE_URL": database, **environment}
    with (folder.parent / f"{folder.name}.log").open("wb") as log:
        process = subprocess.Popen(command, env=given, stdout=log, stderr=log)
    service = Service(f"http://127.0.0.1:{port}", folder, process.pid)
    service.http.timeout = httpx.Timeout(120)
    try:
        until(lambda: _answers(service), bool, STARTED_WITHIN_S)
        yield service
    finally:
        service.http.close()
        process.terminate()
        process.wait(60)


def _answers(service: Service) -> bool:
    try:
        return bool(service.get("/abort")["workers"])
    except httpx.HTTPError:
        return False
