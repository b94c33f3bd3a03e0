"""A mapping as YAML for people: only the fields that are set, and the reason beside each column."""

from __future__ import annotations

import io
from collections.abc import Mapping as Texts
from typing import Any

from rths_engine.recordings.measured.mapping import Mapping


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


def _set(value: Any, exclude: set[str] | None = None) -> dict[str, Any]:
    found: dict[str, Any] = value.model_dump(mode="json", by_alias=True, exclude=exclude, exclude_defaults=True)
    return ({"schema": value.schema_} | found) if hasattr(value, "schema_") else found


def _quoted(value: Any) -> Any:
    """Text in quotes where it has characters that plain YAML cannot contain."""
    from ruamel.yaml.scalarstring import DoubleQuotedScalarString

    return DoubleQuotedScalarString(value) if isinstance(value, str) and not value.isprintable() else value


def _line(text: str) -> str:
    return "".join(sign if sign.isprintable() else " " for sign in text)
