"""The form of a text file of numbers: its separator, its decimal sign, and the sign between thousands."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from rths_engine.formats.lines import value
from rths_engine.foundation.errors import FileError, Issue

Line = tuple[int, str]

COMMENT = re.compile(r"(?!#N/[AV]\b|#NV\b|#{2,}\s*(?:[,;\t]|$))(?:[#%!]+|//)", re.IGNORECASE)  # `#N/A` is a missing value
MISSING = frozenset({"", "na", "n/a", "nan", "null", "none", "-", "--", "#n/a", "#n/v", "#nv", "nil", "1.#qnan", "-1.#ind"})

# chosen; see docs/decisions/0023
LOOKED_AT = 60  # lines used to determine the form
MOST_FIELDS = 1000
_CANDIDATES = ((";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), ("", "."), ("", ","))
_THOUSANDS = ",.'\u2019\u00a0\u202f "
_GROUPED = re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:([{_THOUSANDS}])\d{{3}})(?:\1\d{{3}})*(?!\d)")

_SIGNED = re.compile(r"[-+]?\d*\.\d+(?:[eEdD][-+]?\d+)?(?:[-+]\d*\.\d+(?:[eEdD][-+]?\d+)?)+")
_AT_SIGN = re.compile(r"(?<=[\d.])(?=[-+])(?<![eEdD])")


@dataclass(frozen=True, slots=True)
class Form:
    """The `separator` (empty: white space), the decimal sign, and the sign between thousands (empty: none) of a text file."""

    separator: str
    decimal: str
    thousands: str = ""

    def fields(self, line: str) -> list[str]:
        """The fields of a line, without white space and quotation marks around them."""
        if '"' in line:
            try:
                row = next(csv.reader([line], delimiter=self.separator or " ", skipinitialspace=True))
            except csv.Error:
                row = line.split(self.separator or None)
            return [field.strip() for field in row if self.separator or field.strip()]
        if self.separator:
            return [field.strip() for field in line.split(self.separator)]
        return [part for field in line.split() for part in at_signs(field) or [field]]

    def number(self, field: str) -> float | None:
        """The number in a field: NaN for a missing value, None where the field is not a number."""
        if field.lower() in MISSING:
            return float("nan")
        if self.thousands and self.thousands in field:
            whole, sign, rest = field.partition(self.decimal)
            if not grouped(whole, self.thousands) or self.thousands in rest:
                return None
            field = whole.replace(self.thousands, "") + sign + rest
        if self.decimal == ",":
            if "." in field:
                return None
            field = field.replace(",", ".")
        return value(field)


def at_signs(field: str) -> list[str]:
    """The numbers of a field that touch where the next has a sign: `1.240-102.794`; empty where this is not certain.

    Each number needs a decimal point: `1.240-102` can be Fortran's 1.240E-102.
    """
    return _AT_SIGN.split(field) if _SIGNED.fullmatch(field) else []


def detected(lines: Sequence[Line]) -> tuple[Form, list[bool]]:
    """The form for which most columns are numbers, and whether each column is numeric. Raises FileError where there is none."""
    best: tuple[tuple[int, bool, int, int], Form, list[bool]] | None = None
    for form in _candidates("\n".join(text for _, text in lines)):
        rows = [form.fields(text) for _, text in lines]
        width = Counter(map(len, rows)).most_common(1)[0][0]
        kept = [row for row in rows if len(row) == width]
        if width > MOST_FIELDS or 2 * len(kept) <= len(rows):
            continue
        numbers = [[form.number(field) is not None for field in row] for row in kept]
        numeric = [2 * sum(column) > len(kept) for column in zip(*numbers, strict=True)]
        score = (sum(numeric) - width, form.separator != "", sum(numeric), sum(map(sum, numbers)))
        if any(numeric) and (best is None or score > best[0]):
            best = score, form, numeric
    if best is None:
        at, line = lines[0]
        fix = "write one row of numbers for each time, separated by comma, semicolon, tab or space"
        raise FileError(Issue(f"line {at}", "is not a row of numbers", line, fix))
    return best[1], best[2]


def refuse_ambiguous(lines: Sequence[Line], form: Form, named: bool) -> None:
    """Raises FileError where a comma can be a decimal sign or a separator of columns or of thousands."""
    looked_at = lines[:LOOKED_AT]
    at, line = lines[0]
    if form.separator == "," and not named and all(re.fullmatch(r"[-+]?\d+,\d+", text) for _, text in looked_at):
        fix = "write numbers with a decimal point, or name the columns in a first line"
        raise FileError(Issue(f"line {at}", "the comma can be a decimal sign or a separator", line, fix))
    if form.decimal == "," and not form.thousands:
        fields = [field for _, text in looked_at for field in form.fields(text) if "," in field]
        if fields and all(grouped(field, ",") for field in fields):
            fix = "write numbers with a decimal point and without a sign between thousands"
            raise FileError(Issue(f"line {at}", "the comma can be a decimal sign or separate thousands", line, fix))


def _candidates(text: str) -> Iterator[Form]:
    """The forms to try; a sign between thousands only where numbers show that it cannot be the decimal sign."""
    yield from (Form(*candidate) for candidate in _CANDIDATES)
    for found in {match[1] for match in _GROUPED.finditer(text)}:
        for separator, decimal in _CANDIDATES:
            quoted = '"' in text
            if found == decimal or (found == separator and not quoted) or (found.isspace() and not separator):
                continue
            sign, point = re.escape(found), re.escape(decimal)
            if found in ",." and not re.search(rf"\d{sign}\d{{3}}(?:{point}\d|{sign}\d{{3}}(?!\d))", text):
                continue
            yield Form(separator, decimal, found)


def refuse_points(rows: Iterable[tuple[int, list[str]]], k: int) -> None:
    """Raises FileError where the points of column `k` more likely separate thousands than begin decimals.

    All of them stand before three digits, a number of 1 to 3 digits has none, and the signal jumps less between such numbers
    where the points separate thousands.
    """
    pointed, whole = "", (0, "")
    texts: list[str] = []
    for at, fields in rows:
        text = fields[k].strip("+-")
        if "." in text:
            if not grouped(text, "."):
                return
            pointed = pointed or text
        elif not whole[0] and re.fullmatch(r"[1-9]\d{0,2}", text):
            whole = at, text
        texts.append(fields[k])
    if pointed and whole[0] and _jumps(texts, "") < _jumps(texts, "."):
        problem = f"the point can be a decimal sign or separate thousands: {whole[1]} beside {pointed}"
        fix = "write all numbers of the column with the same decimals, and without a sign between thousands"
        raise FileError(Issue(f"line {whole[0]}", problem, fix=fix))


def _jumps(texts: Sequence[str], point: str) -> float:
    """The jumps between numbers with and without a point, in parts of the range, where `point` is put for each point."""
    numbers = [found if (found := value(text.replace(".", point))) is not None else 0.0 for text in texts]
    beside = [k for k in range(1, len(texts)) if ("." in texts[k]) != ("." in texts[k - 1])]
    width = max(numbers) - min(numbers)
    return sum(abs(numbers[k] - numbers[k - 1]) for k in beside) / width if width > 0 else 0.0


def grouped(text: str, sign: str) -> bool:
    """Whether the text is a whole number in which `sign` separates thousands."""
    return re.fullmatch(rf"[-+]?[1-9]\d{{0,2}}(?:{re.escape(sign)}\d{{3}})+", text) is not None
