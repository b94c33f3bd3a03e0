"""Memory of a long-lived process of many threads."""

from __future__ import annotations

import ctypes
import gc
import subprocess
import sys
from pathlib import Path

import pytest

from app.memory import ARENAS, spare_the_collector

THREADS = """
import ctypes, sys, threading
from app.memory import share_arenas
if sys.argv[2] == "shared":
    share_arenas()
together = threading.Barrier(8)
def take():
    together.wait()
    kept = [bytes(2000) for _ in range(100)]
    together.wait()
    return kept
threads = [threading.Thread(target=take) for _ in range(8)]
for one in threads: one.start()
for one in threads: one.join()
library = ctypes.CDLL(None)
library.fopen.restype = ctypes.c_void_p
file = ctypes.c_void_p(library.fopen(sys.argv[1].encode(), b"w"))
library.malloc_info(0, file)
library.fclose(file)
"""


def arenas(folder: Path, how: str) -> int:
    """The number of arenas that eight threads made in a process of their own."""
    told = folder / f"{how}.xml"
    subprocess.run([sys.executable, "-c", THREADS, str(told), how], check=True)
    return told.read_text().count("<heap ")


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "malloc_info"), reason="this C library has no arenas")
def test_threads_share_arenas(tmp_path: Path) -> None:
    assert arenas(tmp_path, "own") > ARENAS >= arenas(tmp_path, "shared")


def test_the_collector_does_not_look_through_what_was_loaded_at_the_start() -> None:
    spare_the_collector()
    assert gc.get_freeze_count() > 10_000
    gc.unfreeze()
