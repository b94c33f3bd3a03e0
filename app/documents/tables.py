"""The generated tables by name."""

from __future__ import annotations

from collections.abc import Callable

from app.documents import diagnosis, outputs

TABLES: dict[str, Callable[[], str]] = {
    "imported channels": outputs.imported_channels,
    "channels": outputs.channels,
    "measures": lambda: outputs.measures(further=False),
    "further measures": lambda: outputs.measures(further=True),
    "measures of floors and tests": outputs.measures_of_tests,
    "glossary": outputs.terms,
    "fields of a verdict": diagnosis.verdict_fields,
    "fields of the plots": diagnosis.pictures_fields,
}
