"""Names and units of columns from the last rows of a header, and the quantity that a name or a unit means."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rths_engine.formats import units_row
from rths_engine.formats.plain import header_units
from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.form import COMMENT, Form, Line
from rths_engine.foundation import unit_names

# chosen; see docs/decisions/0023
_MOST_ROWS = 4  # of names and units
_LONGEST_UNIT = 12  # characters of a cell in a row of units

_BRACKETED = re.compile(r"[^\s,;(\[{][^\s,;(\[{]*(?:\s*[(\[{][^)\]}]*[)\]}])?")
_UNIT_IN_NAME = re.compile(r"^(.*\S)\s*[(\[{]\s*([^()\[\]{}]+?)\s*[)\]}]\s*$|^(.+?),\s+(\S+)$")
_MATRIX = re.compile(r"\s*\[([^\[\]]*[;,\t ][^\[\]]*)\]\s*")  # `[t; F; u]`, as MATLAB writes columns
_VALUE = re.compile(r"[-+\d.,:/ T]*\d[-+\d.,:/ T]*")
_SLASH = re.compile(r"([^,]*[^\s,])(?:\s*/\s*|\s+in\s+)(\S+(?:/\S+)?)")  # Kraft/kN, as DIN 1313 writes it; Kraft in kN
_QUANTITIES = {
    "sample number": (
        r"^(?:sample|samples|scan|index|idx|no|nr|n|number|point|punkt|muestra|punto|campione|echantillon|row|record|lfd|#)"
        r"(?: (?:number|no|nr|num|index|id|n|nummer|count))?$",
        r"^(?:numero|numero de|nummer)(?: \w+)?$|^(?:mess|abtast)?(?:punkt|wert) ?(?:nr|nummer)$",
    ),
    "time": (
        r"^(?:t|tt|sec|seconds|clock|elapsed|x value|zeit\w*|temps|tiempo|tempo|sure|zaman)\b|\btime\w*|\bzeit\b|\btemps\b",
        r"\btiempo\b|^date\b|^datum\b|^fecha\b|^uhrzeit\b|\u6642\u9593|\u65f6\u95f4",
    ),
    "acceleration": (r"\bacc\w*|\ba\b|\bag\b|beschl\w*|\baceler\w*|\bacel\b|\bivme\b|\u52a0\u901f\u5ea6",),
    "velocity": (r"\bvel\w*|\bv\b|geschw\w*|\bvitesse\b|\bhiz\b",),
    "displacement": (r"\bdis\w*|\bd\b|\bu\b|\bweg\b|verschieb\w*|deplac\w*|desplaz\w*|spostam\w*|deslocam\w*",),
}
_OF_TEXT = re.compile(r"events?|comments?|notes?|remarks?|marker|bemerkung|kommentar|observaci|comentario|commentaire|commento")
_SIDE = re.compile(r"(?<![a-z])(?:n\s?-\s?s|[eo]\s?-\s?w|u\s?-\s?d|ud|ns|ew|ow)(?![a-z])")
_PATTERNS = tuple((quantity, re.compile("|".join(patterns))) for quantity, patterns in _QUANTITIES.items())
_TRIADS = (
    {"n", "e", "z"}, {"n", "e", "v"}, {"n", "e", "u"}, {"n", "e", "d"}, {"x", "y", "z"}, {"l", "t", "v"},
    {"ns", "ew", "ud"}, {"ns", "ew", "v"}, {"ns", "ew", "z"}, {"ns", "ew", "up"}, {"ns", "we", "ud"}, {"h1", "h2", "v"},
    {"h1", "h2", "up"}, {"h1", "h2", "ud"}, {"h1", "h2", "z"}, {"h1", "h2", "h3"},
)  # fmt: skip
BY_DIMENSION = {"acceleration": "acceleration", "velocity": "velocity", "length": "displacement", "time": "time"}


@dataclass(frozen=True, slots=True)
class Heading:
    """Names of the columns (empty: the header has none), and their units as written (empty: not stated)."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    note: str = ""


def find(header: Sequence[Line], form: Form, width: int, empty: Sequence[int] = ()) -> Heading:
    """The heading above rows of `width` fields. `empty`: columns without any value, of which the last can lack its name.

    Rows that are shorter than their heading by a column of comments or events have no comments.
    """
    rows: list[list[str]] = []
    note = ""
    for at, text in reversed(header):
        if header_units.is_line(_bare(text)) and (
            not form.separator or form.fields(_bare(text))[0].rstrip("= :").find(" ") >= 0
        ):
            continue
        row = _cells(text, form, width, empty)
        if row is None or len(rows) == _MOST_ROWS:
            own = form.fields(_bare(text)) if form.separator else []
            if not rows and len(own) > 1:
                note = f"line {at} has {len(own)} fields, the rows of numbers have {width}: it names no columns"
            break
        rows.insert(0, row)
    if not rows:
        return Heading((), ("",) * width, note)
    units = next((k for k in range(len(rows) - 1, max(-1, len(rows) - 3), -1) if _are_units(rows, k)), None)
    below = rows[units + 1 :] if units else []  # remarks below names and units
    texts = [row for k, row in enumerate(rows) if k != units and not (below and units and k > units)]
    names = _joined(texts) if units is None or units > 0 or len(texts) == 1 else texts[-1]
    given = rows[units] if units is not None else [""] * width
    clean = [re.sub(r"^[(\[{]\s*(.*?)\s*[)\]}]$", r"\1", cell) for cell in given]
    named = tuple(name or f"column {k}" for k, name in enumerate(names, start=1))
    note = f"below the units stands {'; '.join(' '.join(row) for row in below)}: not used" if below else ""
    return Heading(named, tuple("" if cell in {"-", "--"} else cell for cell in clean), note)


def are_components(names: Sequence[str]) -> bool:
    """Whether all names are directions of one instrument: `N, E, Z`, `X, Y, Z`, `L, T, V`, `H1, H2, UP`, `HNE, HNN, HNZ`."""
    bare = [re.sub(r"[^a-z0-9]", "", words.plain(name)) for name in names]
    if not 2 <= len(bare) == len(set(bare)):
        return False
    codes = [found[1] for one in bare if (found := re.fullmatch(r"[bhes][nhlg]([enz123])", one))]
    return len(codes) == len(bare) or any(set(bare) <= triad for triad in _TRIADS)


def name_and_unit(name: str) -> tuple[str, str]:
    """The name without the unit in brackets or after a comma at its end, and this unit; empty where there is none."""
    if (found := _SLASH.fullmatch(name)) and unit_names.read(found[2]).unit and not unit_names.read(name).unit:
        words_before = found[1].split()
        if len(words_before) == 1 or not unit_names.read(words_before[-1]).unit:  # `vel cm/s` is not a velocity in s
            return found[1], found[2]
    if found := _UNIT_IN_NAME.match(name):
        rest, unit = (found[1], found[2]) if found[1] else (found[3], found[4])
        written = unit_names.read(unit)
        if written.unit or (
            found[1] and written.problem and len(unit) <= _LONGEST_UNIT and not re.fullmatch(words.COMPONENT, unit.lower())
        ):
            return rest, unit
    return name, ""


def quantity_of(name: str, unit: str = "") -> str:
    """The quantity that a name means, held against its unit; empty where it is not known."""
    bare = _SIDE.sub(" ", words.plain(name))  # U-D is up and down, not a displacement u
    text = re.sub(r"[^a-z0-9#\u0080-\uffff]+", " ", bare).strip()
    by_name = next((quantity for quantity, pattern in _PATTERNS if pattern.search(text)), "")
    written = unit_names.read(unit)
    if by_name == "sample number" and not written.unit:
        return by_name
    if written.unit and written.dimension != "number":
        by_unit = BY_DIMENSION.get(written.dimension, written.dimension)
        ambiguous = written.dimension in {"mass", "length"} and by_name in {"acceleration", "time"} and len(text) < 2
        return by_name if ambiguous else by_unit
    return by_name


def quantity_in(sentence: str) -> str:
    """The quantity that a line of a header names by a word, not by a letter; empty where it names none."""
    return quantity_of(re.sub(r"(?<![^\W\d_])[^\W\d_](?![^\W\d_])", " ", sentence))


def _bare(text: str) -> str:
    bare = COMMENT.sub("", text, count=1).strip(" ") if COMMENT.match(text) else text
    return found[1] if (found := _MATRIX.fullmatch(bare)) else bare


def _cells(text: str, form: Form, width: int, empty: Sequence[int]) -> list[str] | None:
    """The cells of a header row for `width` columns; None where it has another number of cells, or only numbers."""
    bare = _bare(text)
    rows = [form.fields(bare)]
    if not form.separator:
        rows = [
            re.split(r"\t+", bare.strip()), re.split(r"\s{2,}|\t", bare.strip()), form.fields(bare), _BRACKETED.findall(bare),
            [cell.strip() for cell in re.split("[,;]", bare)],
        ]  # fmt: skip
    elif len(rows[0]) != width and len(rows[0]) < 2 <= width:
        rows += [[cell.strip() for cell in bare.split(sign)] for sign in ";,\t" if sign != form.separator]
        rows.append(_BRACKETED.findall(bare))
    for row in rows:
        row = [cell.strip().strip("\"'").strip() for cell in row]
        while len(row) > width and (not row[-1] or (form.separator and _OF_TEXT.match(words.plain(row[-1])))):
            row = row[:-1]
        if len(row) == width - 1 and width - 1 in empty:
            row = [*row, ""]
        if len(row) == width and any(cell and form.number(cell) is None for cell in row):
            return row
    return None


def _are_units(rows: Sequence[Sequence[str]], at: int) -> bool:
    """Whether a row below or above a row of names holds units: at least half of its cells are known units, none is a name."""
    if len(rows) < 2:
        return False
    cells = [cell for cell in rows[at] if cell and cell not in {"-", "--"}]
    if not cells or any(len(cell) > _LONGEST_UNIT + 2 for cell in cells):
        return False
    timed = any(unit_names.read(cell).dimension == "time" for cell in cells)
    named = any(quantity_of(cell) == "time" and unit_names.read(cell).dimension != "time" for cell in cells)
    return units_row.is_units_row(rows[at]) and (timed or not named)


def _joined(rows: Sequence[Sequence[str]]) -> list[str]:
    """The names in the last row, with the row above where one row fills gaps of the other."""
    last = list(rows[-1])
    if len(rows) < 2 or len(last) < 3:
        return last
    above = rows[-2]
    if any(_VALUE.fullmatch(cell) for cell in above):
        return last  # `Date, 2020-01-01` is no part of names
    gaps = any(bool(one) != bool(other) for one, other in zip(above, last, strict=True))
    full = all(one or other for one, other in zip(above, last, strict=True))
    return [f"{one} {other}".strip() for one, other in zip(above, last, strict=True)] if gaps and full else last
