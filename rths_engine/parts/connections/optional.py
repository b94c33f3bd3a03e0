"""Packages of connections that come with an extra, because most laboratories need none of them."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from rths_engine.parts.connections.connection import Terms


def package(module: str, extra: str, terms: Terms) -> Any:
    """The installed module. Raises RigError that names the extra where it is not installed."""
    try:
        return import_module(module)
    except ImportError:
        problem = f"needs the package {module.partition('.')[0]}, which is not installed"
        raise terms.refused("kind", problem, None, f".venv/bin/pip install -e '.[{extra}]'") from None
