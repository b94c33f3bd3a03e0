"""Conversion of bytes to lines and of lines to numbers, with the line number in every error."""

from __future__ import annotations

import re
from collections.abc import Iterable

from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?"
TOUCHING = re.compile(rf"(?:{NUMBER}){{2,}}+")  # numbers without anything between them; possessive: never tried in other parts
_GLUED = re.compile(NUMBER)
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")
_LONGEST_LINE = 20_000_000


def lines_of(raw: bytes) -> list[str]:
    """The lines of a text file: UTF-8 with or without BOM, or Latin-1; any line end. Raises FileError for binary content."""
    check_text(raw)
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    lines = text.replace("\x1a", "").splitlines()
    for number, line in enumerate(lines, start=1):
        if len(line) > _LONGEST_LINE:
            problem = f"has {len(line)} characters; a line takes at most {_LONGEST_LINE}"
            raise FileError(Issue(f"line {number}", problem, fix="write a few numbers on each line"))
    return lines


def check_text(raw: bytes) -> None:
    """Raises FileError for content that is not text, or not in an encoding that is read."""
    if not raw.strip(b" \t\r\n\x0b\x0c\x1a"):
        raise FileError(Issue("file", "is empty", fix="choose a record file"))
    control = _CONTROL.search(raw)
    if control or raw.startswith(b"%PDF"):
        where = f"byte {control.start()}" if control else "file"
        fix = "give the record as text: PEER AT2, COSMOS V2 or plain columns"
        raise FileError(Issue(where, "is binary, not text", fix=fix))


def decoded(line: bytes) -> str:
    """A line as text, without its end, BOM and the end-of-file sign of DOS: UTF-8, or Latin-1."""
    try:
        text = line.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = line.decode("latin-1")
    return text.replace("\x1a", "").strip("\r\n ")


def value(token: str) -> float | None:
    """`token` as a number, also with Fortran's D exponent; None where it is not a number."""
    try:
        return float(token.replace("D", "E").replace("d", "e")) if "_" not in token else None
    except ValueError:
        return None


def numbers(line: str, where: str, width: int = 0) -> list[float]:
    """The numbers of a line, also where fixed columns of `width` touch. Raises FileError for text that is not a number."""
    line = line.rstrip()
    if not width and "_" not in line:
        try:
            return [float(token) for token in line.split()]
        except ValueError:
            pass  # the slower code below reads touching numbers and D exponents, or reports the error
    if width:
        tokens = [field for start in range(0, len(line), width) if (field := line[start : start + width].strip())]
    else:
        tokens = line.split()
    found: list[float] = []
    for token in tokens:
        number = value(token)
        if number is not None:
            found.append(number)
            continue
        parts = _GLUED.findall(token)
        if len(parts) < 2 or "".join(parts) != token:
            fix = "correct or remove it: only numbers can follow the header"
            raise FileError(Issue(where, "is not a number", token, fix))
        found += [float(part.replace("D", "E").replace("d", "e")) for part in parts]
    return found


def block(lines: Iterable[tuple[int, str]], width: int = 0) -> list[float]:
    """All numbers in pairs of line number and line."""
    return [number for at, line in lines for number in numbers(line, f"line {at}", width)]
