"""Tables of the rooms of the engine and of the service, from the import contracts and the first lines of their docstrings."""

from __future__ import annotations

import ast
import tomllib
from pathlib import Path

from app.documents.markdown import code, table

ROOT = Path(__file__).parents[2]


def rooms(package: str) -> str:
    """The rooms of a package, highest first; rooms of one row do not import each other."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    contracts = tomllib.loads(text)["tool"]["importlinter"]["contracts"]
    (layers,) = (one["layers"] for one in contracts if one["type"] == "layers" and one.get("containers") == [package])
    names = [[name.strip() for name in layer.split("|")] for layer in layers]
    rows = [(str(place), code(name), _about(package, name)) for place, row in enumerate(names, 1) for name in row]
    return table(["row", "room", "holds"], rows)


def _about(package: str, name: str) -> str:
    """The first sentence of the docstring of a module or of a package."""
    above = ROOT / package.replace(".", "/")
    path = above / f"{name}.py" if (above / f"{name}.py").exists() else above / name / "__init__.py"
    return (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").partition("\n\n")[0]
