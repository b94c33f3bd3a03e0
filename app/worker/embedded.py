"""The embedded worker: the web process starts it, restarts it when it dies, and ends it at its own end."""

from __future__ import annotations

import os
import secrets
import subprocess
import sys
import threading
from collections.abc import Callable

from app import logs
from app.config import ANY, Settings
from app.worker.peers import unique

NAME = "embedded"
BACK_OFF_S = (0.2, 10.0)
LIVED_S = 30.0


class EmbeddedWorker:
    """The worker as a child process. Its standard input is a pipe that closes when this process ends, however it ends."""

    def __init__(self, settings: Settings, ended: Callable[[str], None]):
        """`ended` is called with the identity of each worker whose process has ended."""
        self.settings, self.ended = settings, ended
        self.process: subprocess.Popen[bytes] | None = None
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._keep, daemon=True, name="rths-embedded-worker")

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self._stopping.set()
        if self.process is not None:
            self.process.kill()
        self._thread.join(5)

    def _keep(self) -> None:
        delay = BACK_OFF_S[0]
        while not self._stopping.is_set():
            boot = secrets.token_hex(3)
            self.process = self._spawn(boot)
            try:
                self.process.wait(LIVED_S)
            except subprocess.TimeoutExpired:
                delay = BACK_OFF_S[0]
                self.process.wait()
            self.ended(unique(NAME, boot))
            self._stopping.wait(delay)
            delay = min(2 * delay, BACK_OFF_S[1])

    def _spawn(self, boot: str) -> subprocess.Popen[bytes]:
        settings = self.settings
        host = "127.0.0.1" if settings.host in ANY else settings.host
        scheme = "wss" if settings.tls_certificate else "ws"
        known = ["--name", NAME, "--boot", boot]
        command = [sys.executable, "-m", "app.worker", "--with-parent", *known, "--web", f"{scheme}://{host}:{settings.port}"]
        environment = {
            **os.environ,
            "RTHS_DATA": str(settings.data.resolve()),
            "RTHS_DATABASE_URL": settings.database_url,
            "RTHS_STORE": settings.store,
            "RTHS_STORE_ENDPOINT": settings.store_endpoint,
            "RTHS_WORKERS": str(settings.worker_concurrency),
            "RTHS_SWEEP_PROCESSES": str(settings.sweep_processes),
            "RTHS_RIG_HOST": settings.rig_host,
            "RTHS_WORKER_TOKEN": settings.worker_token,
            logs.FORMAT_KEY: settings.log_format,
            logs.LEVEL_KEY: settings.log_level,
            "RTHS_HOST": settings.host,
            "RTHS_TLS_CERTIFICATE": str(settings.tls_certificate or ""),
        }
        return subprocess.Popen(command, stdin=subprocess.PIPE, env=environment)
