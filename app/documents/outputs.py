"""Tables of what a test gives: channels."""

from __future__ import annotations

from app.documents.markdown import code, table
from rths_engine.foundation.units import pretty
from rths_engine.recordings.measured.roles import ROLES
from rths_engine.results.channels import CHANNELS


def imported_channels() -> str:
    """The roles that a column of an imported file can have."""
    rows = [(code(name), role.meaning, ", ".join(role.dimensions), role.counts) for name, role in ROLES.items()]
    return table(["role", "meaning", "quantity", "number of its"], rows)


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
