"""Universal file format, dataset 58: time histories as text (58) or binary (58b), each with its own start and step.

The step is the increment of the header. The time stamps of uneven data have six digits in text, so that they repeat in a long
record; where they lie on the stated increment, the increment is used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from rths_engine.formats import damage, stamps
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory.uff_header import Header
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_OPENING = re.compile(rb"\A\s*-1[ ]*\r?\n[ ]*(\d+)")
_DELIMITER = re.compile(rb"^[ ]{4}-1[ ]*\r?(?:\n|\Z)", re.MULTILINE)
_CLOSING = re.compile(rb"(?:\r?\n)?[ ]{4}-1[ ]*\r?(?:\n|\Z)")
_LINES = 12  # by definition: the number's line and eleven lines of the header
_TIME_HISTORY = 1  # by definition: function type
_FUNCTIONS = {
    2: "an auto spectrum",
    3: "a cross spectrum",
    4: "a frequency response",
    6: "a coherence",
    9: "a power spectral density",
}
_STAMP_DIGITS = 5e-6  # by definition: half a unit of the last digit of E13.5, relative; of a stamp and of the increment


def looks_like(source: Source) -> bool:
    """Whether the content is a universal file."""
    return _OPENING.match(source.head) is not None


def read(source: Source) -> Table:
    """Read the time histories. Raises FileError where a dataset does not follow the definition or is incomplete."""
    with damage.refused("a universal file"):
        return _table(source.bytes())


def _table(raw: bytes) -> Table:
    columns: list[Column] = []
    notes: list[str] = []
    statements: list[Statement] = []
    headers: list[str] = []
    others: set[int] = set()
    for number, (where, kind, lines, body) in enumerate(_datasets(raw), start=1):
        if kind != 58:
            others.add(kind)
            continue
        header = Header.of(lines, f"dataset {number} ({where})")
        headers.append(header.text)
        if header.function != _TIME_HISTORY or header.is_complex:
            notes.append(f"{header.where} is {_FUNCTIONS.get(header.function, 'not a time history')}: left out")
            continue
        refuse_many(header.count)
        found, agreed = _record(header, body)
        columns += found
        statements += agreed
    if not columns:
        kinds = ", ".join(str(kind) for kind in sorted({*others, *([58] if headers else [])})) or "none"
        problem = f"contains no time history (dataset 58, function 1); its datasets are {kinds}"
        raise FileError(Issue("file", "; ".join([problem, *notes]), fix="export the signals as time histories"))
    notes += [f"datasets {', '.join(map(str, sorted(others)))} contain no time histories"] if others else []
    return Table("UFF 58", distinct(columns), notes=tuple(notes), statements=tuple(statements), header="\n\n".join(headers))


def _datasets(raw: bytes) -> Iterator[tuple[str, int, list[str], bytes]]:
    """Place, number, header lines and body of each dataset. The header states the length of a binary body."""
    at = 0
    while (opening := _DELIMITER.search(raw, at)) is not None:
        line = raw.count(b"\n", 0, opening.end()) + 1
        first = raw[opening.end() : opening.end() + 90].split(b"\n")[0]
        kind = re.match(rb"\s*(\d+)", first)
        if kind is None:
            raise FileError(Issue(f"line {line}", "is not the number of a dataset", first.decode("latin-1").strip()))
        lines, begin = _head(raw, opening.end())
        if first[6:7].lower() == b"b":
            end = begin + _size(first, line)
            closing = _CLOSING.match(raw, end)
            if closing is None:
                problem = "the binary data do not end where the header says"
                raise FileError(Issue(f"line {line}", problem, fix="the file is cut or was converted as text: get it again"))
        else:
            closing = _DELIMITER.search(raw, opening.end())
            if closing is None:
                raise FileError(Issue(f"line {line}", "the dataset has no end (-1)", fix="the file is cut: get it again"))
            end = closing.start()
        yield f"line {line}", int(kind[1]), lines, raw[begin:end]
        at = closing.end()


def _head(raw: bytes, at: int) -> tuple[list[str], int]:
    lines = []
    for _ in range(_LINES):
        end = raw.find(b"\n", at)
        if end < 0:
            break
        lines.append(_decoded(raw[at:end]).rstrip("\r"))
        at = end + 1
    return lines, at


def _decoded(line: bytes) -> str:
    try:
        return line.decode()
    except UnicodeDecodeError:
        return line.decode("latin-1")


def _size(first: bytes, line: int) -> int:
    """Bytes of the binary data, by the line `    58b     1     2          11      317168 ...`."""
    try:
        return int(first[31:43])
    except ValueError:
        raise FileError(
            Issue(f"line {line}", "does not state the bytes of its data", first.decode("latin-1").strip())
        ) from None


def _record(header: Header, body: bytes) -> tuple[list[Column], list[Statement]]:
    per = 1 if header.even else 2
    times, values = _binary(header, body) if header.binary else _text(header, body, per)
    told = count(header.count, len(values), header.where, header.name)
    column = Column(header.name, values, header.unit, quantity=header.quantity)
    if header.even or not told.agrees:
        return [header.timed(column)], [told]
    assert times is not None
    places = np.arange(len(times)) * header.step
    digits = _STAMP_DIGITS * (np.abs(header.start + places) + places) + stamps.ROUNDING * header.step
    if header.step > 0 and np.all(np.abs(times - header.start - places) <= digits):
        return [header.timed(column)], [told]
    if np.any(np.diff(times) <= 0):
        problem = f"has {len(times) - len(np.unique(times))} of {len(times)} time stamps twice, and no increment"
        raise FileError(Issue(header.where, problem, fix="export it with even spacing, or as 58b"))
    stamp = Column(f"time of {header.name}", times * header.seconds, "s", quantity="time") if header.seconds else None
    if stamp is None:
        return [Column(f"abscissa of {header.name}", times, header.abscissa_unit), column], [told]
    return stamps.timed([column], stamp), [told]


def _text(header: Header, body: bytes, per: int) -> tuple[Array | None, Array]:
    tokens = body.replace(b"D", b"E").replace(b"d", b"e").split()
    if len(tokens) != per * header.count and header.even:  # numbers of fixed columns can touch
        width = 20 if header.double else 13
        lines = [line.rstrip() for line in body.replace(b"D", b"E").splitlines()]
        tokens = [field for line in lines for k in range(0, len(line), width) if (field := line[k : k + width].strip())]
    try:
        numbers = np.array(tokens, dtype="S32").astype(float)
    except ValueError as error:
        raise FileError(Issue(header.where, f"contains text that is not a number: {error}")) from None
    if per == 1:
        return None, numbers
    return numbers[: len(numbers) // 2 * 2 : 2], numbers[1::2]


def _binary(header: Header, body: bytes) -> tuple[Array | None, Array]:
    if header.floats != 2:
        kind = {1: "DEC VMS", 3: "IBM 5/370"}.get(header.floats, str(header.floats))
        raise FileError(Issue(header.where, f"has numbers in the {kind} form", fix="export it with IEEE numbers"))
    order, real = header.order, "f8" if header.double else "f4"
    if header.even:
        return None, _numbers(header, body, order + real).astype(float)
    for stamp in ("f4", "f8"):  # the definition leaves the stamp's precision to the writer; the stated size decides
        row = np.dtype([("time", order + stamp), ("value", order + real)])
        if len(body) == header.count * row.itemsize:
            found = np.frombuffer(body, row)
            return found["time"].astype(float), found["value"].astype(float)
    problem = f"has {len(body)} bytes for {header.count} pairs of time and value"
    raise FileError(Issue(header.where, problem, fix="get the file again, or export it with even spacing"))


def _numbers(header: Header, body: bytes, kind: str) -> Array:
    size = np.dtype(kind).itemsize
    if len(body) % size:
        raise FileError(Issue(header.where, f"has {len(body)} bytes: no whole number of samples of {size} bytes"))
    return np.frombuffer(body, kind)


FORMAT = Format(
    key="uff58",
    title="Universal file, dataset 58",
    of="measurement",
    extensions=("uff", "unv", "u58"),
    defined="Universal File Format, Structural Dynamics Research Laboratory, University of Cincinnati",
    header="number of samples, start, increment, quantity, unit, names of point and direction",
    compared="number of samples, bytes of the data, time stamps",
    looks_like=looks_like,
    read=read,
    public=6,
    public_check="pyuff 2.5.8; one more states 2,508,876 samples and has 42: it is refused",
)
