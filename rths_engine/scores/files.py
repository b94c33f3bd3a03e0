"""The data sets of a folder, recognised by their content."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
LARGEST = 200_000_000  # bytes: a larger file is not opened


def matlab(folder: Path, variables: set[str]) -> Iterator[tuple[Path, dict[str, Array]]]:
    """The MATLAB files (version 7 or earlier) in the folder and its subfolders that have all the variables, as flat arrays."""
    for path in _files(folder, "*.mat"):
        try:
            held = loadmat(path, variable_names=list(variables))
        except (ValueError, NotImplementedError, OSError, TypeError):
            continue
        if variables <= held.keys():
            yield path, {name: np.asarray(held[name], dtype=float).ravel() for name in variables}


def json_with(folder: Path, keys: set[str]) -> Iterator[tuple[Path, dict[str, Any]]]:
    """The JSON files in the folder and its subfolders that hold an object with all the keys."""
    for path in _files(folder, "*.json"):
        try:
            held = json.loads(path.read_text())
        except (ValueError, OSError):
            continue
        if isinstance(held, dict) and keys <= held.keys():
            yield path, held


def _files(folder: Path, pattern: str) -> Iterator[Path]:
    return (path for path in sorted(folder.rglob(pattern)) if path.is_file() and path.stat().st_size <= LARGEST)
