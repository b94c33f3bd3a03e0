"""Why a line among the numbers of a text is refused, and how to mend it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rths_engine.formats.lines import TOUCHING
from rths_engine.formats.plain.form import COMMENT, Line
from rths_engine.foundation.errors import FileError, Issue

OVERFLOW = re.compile(r"\*{2,}|#{2,}(?![A-Za-z])")
_CORRECT = "correct or remove the line"


def not_a_number(at: int, field: str, what: str = "is not a number") -> FileError:
    """The refusal of a field: stars of an overflow, numbers that touch, or text."""
    if OVERFLOW.search(field):
        problem = f"{what}: a number was too long for its field"
        return FileError(Issue(f"line {at}", problem, field, "get the value from the origin of the file; it is lost here"))
    if TOUCHING.fullmatch(field):
        problem = f"{what}: numbers touch"
        return FileError(
            Issue(f"line {at}", problem, field, "separate them, or state the format, such as (8F10.4), in the header")
        )
    return FileError(Issue(f"line {at}", what, field, _CORRECT))


def text_between(line: Line, after: Sequence[str], header: Sequence[str] = ()) -> FileError:
    """The refusal of a line of text among the numbers; `after` are the texts of the lines that follow."""
    at, text = line
    if OVERFLOW.fullmatch(text.strip()):
        return not_a_number(at, text.strip())
    if text.strip() in {one.strip() for one in header}:
        return FileError(
            Issue(f"line {at}", "repeats the header: a second block of data", text, "give each block in a file of its own")
        )
    if not any(re.search(r"\d", one) and not re.search(r"[A-Za-z]{3}", one) for one in after):
        return FileError(Issue(f"line {at}", "is text after the last number, a footer, and is not a number", text, "remove it"))
    if COMMENT.match(text.lstrip()):
        fix = "move comments above the data, or remove the line"
        return FileError(Issue(f"line {at}", "is a comment among the numbers and is not a number", text, fix))
    return FileError(Issue(f"line {at}", "is not a number", text, "correct or remove it: only numbers can follow the header"))


def touches(field: str) -> bool:
    """Whether a field is several numbers without anything between them, or stars of a number that was too long."""
    return bool(TOUCHING.fullmatch(field) or OVERFLOW.search(field))


def other_width(at: int, text: str, count: int, others: int, what: str = "fields") -> FileError:
    """The refusal of a row with another number of fields than the other rows."""
    return FileError(Issue(f"line {at}", f"has {count} {what}; the others have {others}", text, _CORRECT))


def blank_between(at: int) -> FileError:
    """The refusal of numbers after a blank line."""
    fix = "give each block in a file of its own, or remove the blank line"
    return FileError(Issue(f"line {at}", "follows a blank line: a second block of data, or a line is missing", fix=fix))
