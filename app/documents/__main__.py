"""`make docs`: write the generated tables into docs/*.md."""

from __future__ import annotations

from pathlib import Path

from app.documents.regions import renewed

if __name__ == "__main__":
    for path in sorted((Path(__file__).parents[2] / "docs").glob("*.md")):
        text = path.read_text(encoding="utf-8")
        if (new := renewed(text)) != text:
            path.write_text(new, encoding="utf-8")
            print(f"{path.name}: updated")
