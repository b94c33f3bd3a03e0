"""The list of decision records."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parents[2] / "docs" / "decisions"


def decisions() -> str:
    """Every decision record with its title, as links from docs/README.md."""
    titles = {path.name: path.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ") for path in FOLDER.glob("*.md")}
    return "\n".join(f"- [{title}](decisions/{name})" for name, title in sorted(titles.items()))
