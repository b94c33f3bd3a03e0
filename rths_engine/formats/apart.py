"""Read binary formats in a separate process, because a damaged file can crash the reader or block it for ever.

The first file starts the process, which serves all later files. Requests and replies are pickled through its pipes.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import pickle
import subprocess
import sys
import threading
from typing import Any

from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_SERVING = "rths_engine.formats.serving"  # imported only by that process
PATIENCE_S = 60.0  # the largest file takes some seconds
TRIES = 2  # the file before can have left the process in a bad state


def read(source: Source, key: str) -> Table:
    """Read a file of the format `key`. Raises FileError, also where reading crashes or does not end."""
    for _ in range(TRIES):
        try:
            kind, answer = _READER.ask((source, key))
        except TimeoutError:
            break
        except (EOFError, OSError, pickle.UnpicklingError):
            continue
        if kind == "table":
            table: Table = answer
            return table
        raise FileError(answer) if kind == "refused" else answer
    raise FileError(
        Issue("file", "is damaged: reading it crashes or does not end", fix="write the file again, or export it as CSV")
    )


class Reader:
    """The separate process of the reader: one process at a time, one file at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None

    def ask(self, asked: tuple[Source, str]) -> tuple[str, Any]:
        """The reply for a file. Raises EOFError or OSError for a crash of the process, TimeoutError after PATIENCE_S."""
        with self._lock:
            process = self._started()
            assert process.stdin and process.stdout
            late = threading.Event()

            def give_up() -> None:
                late.set()
                process.kill()

            timer = threading.Timer(PATIENCE_S, give_up)
            timer.daemon = True
            timer.start()
            try:
                pickle.dump(asked, process.stdin)
                process.stdin.flush()
                found: tuple[str, Any] = pickle.load(process.stdout)
                return found
            except BaseException:
                self._end()  # the process is still reading this file
                if late.is_set():
                    raise TimeoutError from None
                raise
            finally:
                timer.cancel()

    def stop(self) -> None:
        with self._lock:
            self._end()

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None or self._process.poll() is not None:
            self._end()
            command = [sys.executable, "-c", f"from {_SERVING} import serve; serve()"]
            pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
            self._process = subprocess.Popen(command, env=environment, **pipes)
        return self._process

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for pipe in (process.stdin, process.stdout):
                assert pipe
                with contextlib.suppress(OSError):  # data that was not sent
                    pipe.close()


_READER = Reader()
stop = _READER.stop
atexit.register(stop)
