"""How a long-lived process of many threads keeps its memory: docs/decisions/0082."""

from __future__ import annotations

import ctypes
import gc

ARENA_MAX = -8  # M_ARENA_MAX of glibc's malloc.h
ARENAS = 2


def share_arenas() -> None:
    """Let all threads take memory from ARENAS arenas of the C library, before the threads begin.

    By default glibc makes up to eight arenas for each core, one after the other for new threads, and each keeps what is free
    in its middle: after 1400 tests as much as the web service had grown. Other C libraries have no such arenas.
    """
    options = getattr(ctypes.CDLL(None), "mallopt", None)
    if options is not None:
        options(ARENA_MAX, ARENAS)


def spare_the_collector() -> None:
    """Let the garbage collector leave alone what a process loaded at its start.

    Looking through all of it stopped every thread for 0.25 s, and with them Abort and the frames of viewers.
    """
    gc.collect()
    gc.freeze()
