"""Tables of the effects that a model can be extended by."""

from __future__ import annotations

from collections.abc import Sequence

from app.documents.fields import HEADS, equation, rows
from app.documents.markdown import code, table
from rths_engine.parts.physics import SEARCHES
from rths_engine.parts.physics.effect import (
    COMMAND,
    F_SENSOR,
    FORCE,
    GROUND,
    HEAT,
    INPUT,
    MATRICES,
    PART,
    PISTON,
    SERIES,
    STOREY,
    X_SENSOR,
    Effect,
)

ACTS_ON = {
    COMMAND: "command",
    PISTON: "piston",
    INPUT: "displacement that reaches the specimen",
    SERIES: "spring before the specimen",
    FORCE: "specimen's force",
    HEAT: "specimen's force",
    X_SENSOR: "displacement reading",
    F_SENSOR: "force reading",
    STOREY: "force in a storey",
    PART: "fields of the part",
    MATRICES: "M, C and K",
    GROUND: "ground acceleration",
}


def effects(registry: Sequence[type[Effect]]) -> str:
    """The effects of a component with what a diagnosis needs to find them, then every field of every effect."""
    listed = [
        (
            _id(kind),
            kind.title,
            equation(kind),
            ACTS_ON[kind.hook],
            ", ".join(code(role) for role in SEARCHES[kind].needs),
            ", ".join(code(other) for other in SEARCHES[kind].relatives),
        )
        for kind in registry
    ]
    fields = [row for kind in registry for row in rows(kind, f"{_id(kind).strip('`')}.")]
    heads = ["kind", "name", "equation", "acts on", "channels that a diagnosis needs", "similar effects"]
    return f"{table(heads, listed)}\n\n{table(HEADS, fields)}"


def _id(kind: type[Effect]) -> str:
    """`kind`, with its channel for an effect of a sensor: `offset (x_meas)`."""
    channel = kind.model_fields.get("channel")
    name = kind.model_fields["kind"].default
    return code(f"{name} ({channel.default})" if channel else name)
