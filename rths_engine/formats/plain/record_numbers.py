"""The numbers in the lines of a record: their separator, their decimal sign, and fields of a Fortran format that touch."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rths_engine.formats.lines import value
from rths_engine.formats.plain.form import Line, at_signs
from rths_engine.formats.plain.refusals import not_a_number
from rths_engine.foundation.errors import FileError, Issue

_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eEdD][-+]?\d+)?")


def rows_of(data: Sequence[Line], width: int = 0) -> tuple[list[tuple[int, list[float]]], list[str]]:
    """The numbers of each line, and its text. `width`: of a field where the header states a Fortran format.

    Raises FileError for a field that is not a number, for an empty field, and where the comma is ambiguous.
    """
    separator, decimal_comma = _separator(data)
    rows: list[tuple[int, list[float]]] = []
    for at, text in data:
        fields = [text]
        if separator:
            fields = text.removesuffix(separator).split(separator)
            if not all(field.strip() for field in fields):
                raise FileError(Issue(f"line {at}", "has an empty field", text, "fill the field or remove the line"))
        plain = " ".join(fields)
        rows.append((at, _numbers(plain.replace(",", ".") if decimal_comma else plain, at, 0 if separator else width)))
    return rows, [text for _, text in data]


def _numbers(text: str, at: int, width: int) -> list[float]:
    tokens = text.split()
    found = [value(token) for token in tokens]
    if None in found:
        tokens = [part for token in tokens for part in at_signs(token) or [token]]
        found = [value(token) for token in tokens]
    if width and None in found:
        padded = text.rjust(-(-len(text) // width) * width)
        tokens = [padded[start : start + width].strip() for start in range(0, len(padded), width)]
        found = [value(token) for token in tokens]
    for token, number in zip(tokens, found, strict=True):
        if number is None:
            raise not_a_number(at, token)
    return [number for number in found if number is not None]


def _separator(data: Sequence[Line]) -> tuple[str, bool]:
    """Separator (empty: spaces), and whether the comma is the decimal sign. Raises FileError where this is ambiguous."""
    text = "\n".join(line for _, line in data)
    separator = next((sign for sign in ";\t" if sign in text), "")
    if "," not in text:
        return separator, False
    if "." in text:
        if separator:
            at, line = next((at, line) for at, line in data if "," in line)
            raise FileError(Issue(f"line {at}", "has both comma and point", line, "write numbers with a decimal point only"))
        return ",", False
    fields = re.split(separator or r"\s+", text.replace("\n", separator or "\n"))
    if separator or any(len(line.split()) > 1 for _, line in data):
        with_comma = [field.strip() for field in fields if "," in field]
        if all(_DECIMAL_COMMA.fullmatch(field) for field in with_comma):
            return separator, True
    at, line = next((at, line) for at, line in data if "," in line)
    fix = "write numbers with a decimal point, or separate the columns by semicolons"
    raise FileError(Issue(f"line {at}", "the comma can be a decimal sign or a separator", line, fix))
