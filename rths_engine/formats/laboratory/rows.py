"""Rows of numbers between separators: the columns that are wanted, with the line in every error."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial

import numpy as np

from rths_engine.formats.table import refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

Line = tuple[int, str]
_NUMBER = re.compile(r"[-+]?(?:\d+[.]?\d*|[.]\d+)(?:[eE][-+]?\d+)?|[-+]?(?:nan|inf|infinity)", re.IGNORECASE)


def fields(text: str, separator: str) -> list[str]:
    """The fields of a line; an empty `separator` is white space."""
    return [one.strip() for one in text.split(separator)] if separator else text.split()


def number(field: str, decimal: str = ".") -> float | None:
    """The number in a field with the decimal sign `decimal`; None where it is not a number, NaN where it is empty."""
    if not field:
        return float("nan")
    if decimal == ",":
        field = "" if "." in field else field.replace(",", ".")
    return float(field) if _NUMBER.fullmatch(field) else None


def decimal_sign(lines: Sequence[Line], separator: str) -> str:
    """The decimal sign of rows that do not state it: the comma where fields contain commas and no points."""
    if separator == ",":
        return "."
    found = [
        one for _, text in lines for one in fields(text, separator) if re.fullmatch(r"[-+]?\d*[.,]\d*(?:[eE][-+]?\d+)?", one)
    ]
    return "," if found and all("," in one for one in found if "." in one or "," in one) else "."


def values(
    lines: Sequence[Line], separator: str, decimal: str, wanted: Sequence[int], widths: range, names: Sequence[str]
) -> tuple[Array, np.ndarray]:
    """The numbers of the `wanted` columns, and where a field is empty; both with one row for each line.

    `widths`: the numbers of fields that a row can have. Raises FileError with the line for a row of another width and for text.
    """
    refuse_many(len(lines) * len(wanted))
    if not lines:
        return np.empty((0, len(wanted))), np.empty((0, len(wanted)), dtype=bool)
    for at, text in lines:
        width = len(text.split(separator or None))
        if width not in widths:
            usual = f"{widths[0]}" if len(widths) == 1 else f"{widths[0]} to {widths[-1]}"
            problem = f"has {width} fields; {usual} are expected"
            raise FileError(Issue(f"line {at}", problem, text.strip(), "correct the line, or cut the file before it"))
    if decimal == "." or not any("." in text for _, text in lines):
        texts = (text.replace(",", ".") if decimal == "," else text for _, text in lines)
        load = partial(np.loadtxt, delimiter=separator or None, comments=None, ndmin=2, usecols=tuple(wanted))
        try:
            whole: Array = load(texts)
            return whole, np.zeros(whole.shape, dtype=bool)
        except ValueError:
            pass  # the slower code below reads empty fields or reports the error
    result = np.full((len(lines), len(wanted)), np.nan)
    empty = np.ones(result.shape, dtype=bool)
    for row, (at, text) in enumerate(lines):
        given = fields(text, separator)
        for column, k in enumerate(wanted):
            if k >= len(given) or not given[k]:
                continue
            found = number(given[k], decimal)
            if found is None:
                problem = f"column {names[column]} is not a number"
                raise FileError(Issue(f"line {at}", problem, given[k], "correct the line, or cut the file before it"))
            result[row, column], empty[row, column] = found, False
    return result, empty


def up_to_last(column: Array, empty: np.ndarray, lines: Sequence[Line], name: str) -> Array:
    """The column up to its last filled field. Raises FileError with the line for an empty field before that."""
    filled = np.flatnonzero(~empty)
    count = int(filled[-1]) + 1 if len(filled) else 0
    if (gaps := np.flatnonzero(empty[:count])).size:
        fix = "fill the field, or export the channel alone"
        raise FileError(Issue(f"line {lines[int(gaps[0])][0]}", f"column {name} is empty between its values", fix=fix))
    return column[:count]
