"""`make docs`: write the generated tables into the documents."""

from __future__ import annotations

from app.documents.regions import documents, renewed

if __name__ == "__main__":
    for path in documents():
        text = path.read_text(encoding="utf-8")
        if (new := renewed(text)) != text:
            path.write_text(new, encoding="utf-8")
            print(f"{path.name}: updated")
