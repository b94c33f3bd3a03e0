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

INTERPRETED = ("recordings", "stability", "table4", "diagnosis")


def source_digest() -> str:
    """Hex SHA-256 over numba's version and the engine's Python sources, but for the folders that hold nothing compiled."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(root.rglob("*.py")):
        if path.relative_to(root).parts[0] in INTERPRETED:
            continue
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

    Written out as one chain of branches: a function for each branch compiles twice as long, and deepens the compiler's
    recursion. Each dispatch is named by what it holds. Code that was kept on disk finds what it calls by name, and would call
    another process's dispatch of the same name.
    """
    last = len(steps) - 1
    branches = [f"    if code == {code}:\n        return step_{code}(*args)" for code in range(last)]
    scope = {f"step_{code}": compiled(step) for code, step in enumerate(steps)}
    exec("\n".join(["def dispatch(code, *args):", *branches, f"    return step_{last}(*args)"]), scope)
    return compiled(named(scope["dispatch"], steps))


def named(function: Callable[..., Any], steps: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    """The closure under a name of its own: a digest of what it calls."""
    held = "|".join(f"{step.__module__}.{step.__qualname__}" for step in steps)
    function.__qualname__ = f"{function.__name__}_{hashlib.sha256(held.encode()).hexdigest()[:16]}"
    return function
