"""Readers that come with the extra `formats`, because their licence is copyleft or their size is not for everyone."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from rths_engine.foundation.errors import FileError, Issue


def package(module: str, format: str) -> ModuleType:
    """The installed module. Raises FileError that names the extra where it is not installed."""
    try:
        return import_module(module)
    except ImportError:
        problem = f"is {format}, for which the package {module.partition('.')[0]} is needed"
        raise FileError(Issue("file", problem, fix=".venv/bin/pip install -e '.[formats]'")) from None
