"""A mapping as YAML for people: only the fields that are set, and the reason beside each column."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping as Texts
from typing import Any

import numpy as np

from rths_engine.formats.table import Table
from rths_engine.foundation import unit_names
from rths_engine.recordings.measured import names
from rths_engine.recordings.measured.mapping import SCHEMA, Mapping
from rths_engine.recordings.measured.roles import ROLES


def write(mapping: Mapping, reasons: Texts[str, str] | None = None, left_out: Texts[str, str] | None = None) -> str:
    """The mapping as YAML. `reasons` and `left_out`, by the name of the column, become comments."""
    from ruamel.yaml import YAML
    from ruamel.yaml.comments import CommentedMap, CommentedSeq

    data = CommentedMap({name: _quoted(value) for name, value in _set(mapping, exclude={"channels"}).items()})
    channels = CommentedSeq()
    for channel in mapping.channels:
        fields = CommentedMap({name: _quoted(value) for name, value in _set(channel).items()})
        if reason := (reasons or {}).get(str(channel.column), ""):
            fields.yaml_add_eol_comment(_line(reason), "column")
        channels.append(fields)
    data["channels"] = channels
    yaml = YAML()
    yaml.width = 200
    stream = io.StringIO()
    yaml.dump(data, stream)
    for column, reason in (left_out or {}).items():
        stream.write(f"# left out: {_line(column)}: {_line(reason)}\n")
    return stream.getvalue()


def to_complete(table: Table) -> str:
    """A mapping whose channels are comments: the columns of a file of which none is recognised, to be given role and unit."""
    lines = [
        "# no column is recognised as a measurement: for each channel give its role and unit, and remove the signs # before it",
        f"# roles: {', '.join(ROLES)}",
        f"schema: {SCHEMA}",
    ]
    if all(one.dt is None for one in table.columns):
        lines.append("# rate: ?  # Hz, unless a column is time, with the role t")
    lines.append("channels:")
    for one in table.columns:
        stated = f", in {one.unit}" if one.unit else ""
        finite = one.values[np.isfinite(one.values)]
        extent = f", {finite.min():.4g} to {finite.max():.4g}" if len(finite) else ""
        step = f", step {one.dt:g} s" if one.dt is not None else ""
        name = json.dumps(one.name, ensure_ascii=False)
        lines.append(f"# - column: {name}  # {len(one.values)} values{extent}{stated}{step}")
        role = "t" if names.read(one.name, one.unit, one.quantity).role == "t" else "?"
        lines += [f"#   role: {role}", f"#   unit: {unit_names.read(one.unit).plain or '?'}"]
    return "".join(f"{_line(line)}\n" for line in lines)


def _set(value: Any, exclude: set[str] | None = None) -> dict[str, Any]:
    found: dict[str, Any] = value.model_dump(mode="json", by_alias=True, exclude=exclude, exclude_defaults=True)
    return ({"schema": value.schema_} | found) if hasattr(value, "schema_") else found


def _quoted(value: Any) -> Any:
    """Text in quotes where it has characters that plain YAML cannot contain."""
    from ruamel.yaml.scalarstring import DoubleQuotedScalarString

    return DoubleQuotedScalarString(value) if isinstance(value, str) and not value.isprintable() else value


def _line(text: str) -> str:
    return "".join(sign if sign.isprintable() else " " for sign in text)
