"""Compilation, all in this module. Parts are plain Python; `compiled`, `piece`, `entry` and `fold` make machine code of them.

Entry points are stored on disk under a digest of everything that they are compiled from (`fingerprint`). numba's own cache
checks only the file of the entry point: it would use old code after a change in a part, and would compile again after a change
in a docstring.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numba

from rths_engine.foundation.fingerprint import fingerprint

_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False, "_nrt": True}
# numba hands `_nrt`, the counting of references, on to callees that do not state it, so every function states it
_OF_PIECES: dict[str, Any] = {**_OPTIONS, "forceinline": True, "_nrt": False}


class Kept:
    """Where numba stores the machine code of one entry point: an implementation of numba's cache locator protocol."""

    def __init__(self, function: Callable[..., Any]):
        self.digest = fingerprint(function, numba.__version__, _OF_PIECES)

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> Kept:
        return cls(function)

    def ensure_cache_path(self) -> None:
        _folder().mkdir(parents=True, exist_ok=True)

    def get_cache_path(self) -> str:
        return str(_folder())

    def get_source_stamp(self) -> str:
        return self.digest

    def get_disambiguator(self) -> str:
        return self.digest[:16]


@lru_cache(maxsize=1)
def _folder() -> Path:
    base = os.environ.get("RTHS_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(base) / "rths"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return folder
    except OSError:
        pass
    return Path(tempfile.gettempdir()) / f"rths-{os.getuid()}"


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call."""
    return numba.njit(**_OPTIONS)(function)


def piece(function: Callable[..., Any]) -> Any:
    """Compile a piece of a loop into each of its callers, without counting references to arrays.

    A piece gets the whole data of a run, and counting a reference to each of its arrays takes as long as the piece itself. The
    entry point holds these arrays, so a piece does without. In return it creates no array, and receives and returns none except
    from and to other pieces.
    """
    return numba.njit(**_OF_PIECES)(function)


def entry(function: Callable[..., Any]) -> Any:
    """Compile a function that Python calls, and store it on disk."""
    config: Any = numba.config
    others = config.CACHE_LOCATOR_CLASSES
    config.CACHE_LOCATOR_CLASSES = f"{__name__}.{Kept.__name__}"
    try:
        return numba.njit(cache=True, **_OPTIONS)(function)
    finally:
        config.CACHE_LOCATOR_CLASSES = others


def fold(steps: Sequence[Callable[..., Any]]) -> Any:
    """One compiled `dispatch(code, *args)` that calls `steps[code](*args)`; a code above the last calls the last step.

    The source is one chain of branches. One function for each branch would double the compile time and deepen the recursion of
    the compiler. The name of each dispatch contains a digest of its steps, because stored code finds its callees by name: with
    equal names it would call the dispatch of another process.
    """
    last = len(steps) - 1
    branches = [f"    if code == {code}:\n        return step_{code}(*args)" for code in range(last)]
    scope = {f"step_{code}": compiled(step) for code, step in enumerate(steps)}
    exec("\n".join(["def dispatch(code, *args):", *branches, f"    return step_{last}(*args)"]), scope)
    return compiled(named(scope["dispatch"], steps))


def named(function: Callable[..., Any], steps: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    """The function with a unique name that contains a digest of the functions it calls."""
    held = "|".join(f"{step.__module__}.{step.__qualname__}" for step in steps)
    function.__qualname__ = f"{function.__name__}_{hashlib.sha256(held.encode()).hexdigest()[:16]}"
    return function
