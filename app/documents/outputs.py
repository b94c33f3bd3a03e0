"""Tables of the outputs of a test: measures, channels and the glossary."""

from __future__ import annotations

from collections.abc import Iterable

from app.documents.markdown import code, table
from rths_engine.foundation.unit_spellings import SPELLINGS
from rths_engine.foundation.units import pretty
from rths_engine.recordings.measured.roles import RAW, ROLES, SI, UNITS, dimension
from rths_engine.results.channels import CHANNELS
from rths_engine.results.glossary import glossary
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

MOST_SPELLINGS = 6  # of a quantity, in the table of units


def imported_channels() -> str:
    """The roles that a column of an imported file can have."""
    rows = [(code(name), role.meaning, ", ".join(role.dimensions), role.counts) for name, role in ROLES.items()]
    return table(["role", "meaning", "quantity", "number counts"], rows)


def units_of_columns() -> str:
    """The units that a column of an imported file can have, by quantity, with their spellings in files."""
    kinds = dict.fromkeys(dimension(unit) for unit in UNITS)
    rows = []
    for kind in kinds:
        known = [unit for unit in UNITS if dimension(unit) == kind]
        spelled = [spelling for unit in known for spelling in SPELLINGS.get(unit, ()) if spelling.isalpha()]
        uses = "a gain is needed" if kind in RAW else "" if kind in SI else "no role"
        rows.append((kind, ", ".join(code(unit) for unit in known), ", ".join(spelled[:MOST_SPELLINGS]), uses))
    return table(["quantity", "units", "spellings, for example", "use"], rows)


def channels() -> str:
    """Every channel, recorded or imported."""
    rows = [
        (
            code(f"{name}.N" if role.counts else name),
            role.label,
            role.symbol,
            pretty(role.unit),
            pretty(role.shown),
            role.counts,
            "derived" if role.derived else "measured",
            role.meaning,
        )
        for name, role in CHANNELS.items()
    ]
    return table(["key", "channel", "symbol", "SI unit", "shown in", "N counts", "kind", "meaning"], rows)


def measures(further: bool) -> str:
    """The measures of a station: those in the first table of a result or, with `further`, those in the second."""
    return _measures([one for one in of(StationMeasure) if one.further == further])


def measures_of_tests() -> str:
    """The measures of floors and of whole tests."""
    return _measures([*of(FloorMeasure), *of(RunMeasure)])


def terms() -> str:
    """The glossary."""
    return table(["term", "symbol", "unit", "meaning"], glossary())


def _measures(some: Iterable[Measure]) -> str:
    rows = [
        (one.label, code(one.key), one.formula, one.shown_label, ", ".join(one.tests), one.meaning, one.source) for one in some
    ]
    return table(["measure", "key", "formula", "unit", "tests", "meaning", "source"], rows)
