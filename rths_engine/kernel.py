"""The only place that compiles. Parts are plain Python; `compiled`, `entry` and `fold` turn them into one machine code.

Entry points are cached on disk in a folder named by a digest of the engine's sources: numba alone checks only the file
of the entry point itself, and would keep serving stale code after an edit to a part.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numba


def source_digest() -> str:
    """Hex SHA-256 over the engine's Python sources and numba's version."""
    root = Path(__file__).parent
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(root.rglob("*.py")):
        digest.update(path.relative_to(root).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _cache_folder() -> Path:
    base = os.environ.get("RTHS_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(base) / "rths" / source_digest()[:16]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return folder
    except OSError:
        pass
    return Path(tempfile.gettempdir()) / f"rths-{os.getuid()}" / folder.name


numba.config.CACHE_DIR = str(_cache_folder())  # type: ignore[attr-defined]

_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False}


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call."""
    return numba.njit(**_OPTIONS)(function)


def entry(function: Callable[..., Any]) -> Any:
    """Compile a function that Python calls; kept on disk."""
    return numba.njit(cache=True, **_OPTIONS)(function)


def fold(steps: Sequence[Callable[..., Any]]) -> Any:
    """One compiled `dispatch(code, *args)` that calls `steps[code](*args)`; the last step answers any higher code.

    Each dispatch is named by what it holds. Code that was kept on disk finds what it calls by name, and would call another
    process's closure of the same name and number.
    """
    last = compiled(steps[-1])

    def only(code, *args):
        return last(*args)

    dispatch = compiled(_named(only, 0, steps[-1:]))
    for code in reversed(range(len(steps) - 1)):
        dispatch = _choice(code, steps[code:], dispatch)
    return dispatch


def _choice(own: int, steps: Sequence[Callable[..., Any]], rest: Any) -> Any:
    step = compiled(steps[0])

    def choose(code, *args):
        if code == own:
            return step(*args)
        return rest(code, *args)

    return compiled(_named(choose, own, steps))


def _named(function: Callable[..., Any], own: int, steps: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    held = "|".join(f"{step.__module__}.{step.__qualname__}" for step in steps)
    function.__qualname__ = f"{function.__name__}_{own}_{hashlib.sha256(held.encode()).hexdigest()[:16]}"
    return function
