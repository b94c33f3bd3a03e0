"""The blocks of a text of one record: header lines and the numbered lines of numbers below them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rths_engine.formats.lines import value
from rths_engine.formats.plain import count_line, header_facts, headings
from rths_engine.formats.plain.form import MISSING, Line
from rths_engine.formats.plain.refusals import OVERFLOW, blank_between, not_a_number, text_between
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
FEWEST = 8  # numbers of a block
_MOST_ABOVE = 3  # lines of numbers in a header

_COMMENT = ("#", "%", "!", "//", "'", ";", "*")
_NUMERIC = re.compile(r"[-+\d.,;\seEdD*'\u2019]*\d[-+\d.,;\seEdD*'\u2019]*")
_DAY = re.compile(r"\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[-/.]\d{1,2}[-/.]\d{4}")


@dataclass
class Block:
    """Lines of a header and the lines of numbers below them. `apart`: a blank line stands above, in place of a header."""

    header: list[Line]
    rows: list[Line]
    apart: bool = False


def split(lines: Sequence[Line]) -> list[Block]:
    """The blocks of a text. Raises FileError for text among the numbers that does not begin a block, and for a footer."""
    blocks = [Block([], [])]
    blank: int | None = None
    doubled = _doubled(lines)
    for at, line in lines:
        text = line.strip()
        if not text:
            blank = at
            continue
        current = blocks[-1]
        if is_numbers(text):
            if current.rows and blank is not None and not doubled:
                blocks.append(Block([], [], apart=True))
            blocks[-1].rows.append((at, text.replace('"', "")))
        elif current.rows:
            blocks.append(Block([(at, text)], []))
        else:
            current.header.append((at, text))
        blank = None
    return _checked(_folded(blocks), lines)


def is_numbers(text: str) -> bool:
    """Whether a line holds numbers, also where they are damaged: stars, numbers that touch."""
    if text.startswith(_COMMENT) and text.lower() not in MISSING and not (OVERFLOW.match(text) and re.search(r"\d", text)):
        return False
    bare = text.replace('"', "")
    if _NUMERIC.fullmatch(bare):
        return not _DAY.fullmatch(bare)
    fields = [field for field in re.split(r"[\t;,\s]+", bare) if field]
    return all(value(field) is not None or (field.lower() in MISSING and field.strip("-")) for field in fields)


def _doubled(lines: Sequence[Line]) -> bool:
    """Whether a blank line follows every line of numbers."""
    kinds = [bool(text.strip()) for _, text in lines if not text.strip() or is_numbers(text.strip())]
    filled = sum(kinds)
    return filled > 2 and len(kinds) - filled >= filled - 1


def _folded(blocks: list[Block]) -> list[Block]:
    """The blocks; a few lines of numbers above a header, written otherwise than the samples, belong to the header."""
    folded: list[Block] = []
    for block in reversed(blocks):
        if folded and block.rows and len(block.rows) <= _MOST_ABOVE and folded[0].rows:
            below = folded[0]
            other = all(len(text.split()) != len(below.rows[0][1].split()) for _, text in block.rows)
            counted = len(block.rows) == 1 and (found := count_line.parsed(block.rows[0])) and found.count == count(below.rows)
            if other or counted:
                folded[0] = Block([*block.header, *block.rows, *below.header], below.rows, block.apart)
                continue
        folded.insert(0, block)
    return folded


def count(rows: Sequence[Line]) -> int:
    """How many numbers the lines hold."""
    return sum(len(re.split(r"[\t;,\s]+", text.strip("\t;, "))) for _, text in rows)


def _checked(blocks: list[Block], lines: Sequence[Line]) -> list[Block]:
    first = blocks[0]
    if not first.rows:
        text = next((text.strip() for _, text in lines if text.strip()), "")
        raise FileError(Issue("file", "contains no numbers", text, "give PEER AT2, COSMOS V2, or columns of numbers"))
    last = first.header[-1:]
    if last and OVERFLOW.fullmatch(last[0][1]) and len(last[0][1]) <= _longest(first.rows):
        raise not_a_number(last[0][0], last[0][1])
    if len(blocks) > 1 and count(first.rows) < FEWEST:
        raise count_line.refusal(first.rows[0], count(blocks[1].rows))
    for block in blocks[1:]:
        start = (block.header or block.rows)[0]
        short = not block.rows or count(block.rows) < FEWEST
        if block.apart and not block.header and short:
            raise blank_between(start[0])
        if block.header and any(
            [text for _, text in one.header] == [text for _, text in block.header] for one in blocks if one is not block
        ):
            raise text_between(start, [], [start[1]])
        if block.header and (short or not _announces(block.header)):
            after = [text for at, text in lines if at > start[0]]
            raise text_between(start, after, [text for _, text in first.header])
    return blocks


def _longest(rows: Sequence[Line]) -> int:
    return max(len(field) for _, text in rows[:100] for field in text.split()) + 4


def _announces(header: Sequence[Line]) -> bool:
    """Whether the lines name a block of samples: by quantity, component, count or step."""
    facts = header_facts.read(header)
    if facts.counts or facts.steps or facts.peaks or facts.components:
        return True
    return any(
        headings.quantity_in(text) in {"acceleration", "velocity", "displacement"} or component_in(text) for _, text in header
    )


def component_in(text: str) -> str:
    """The component that a line names, such as N-S or `Component: EW`; empty where it names none."""
    found = _COMPONENT.search(text)
    return (found[1] or found[2]) if found else ""


def components_in(text: str) -> int:
    """How many components a line names."""
    return len(_COMPONENT.findall(text))


_COMPONENT = re.compile(
    r"(?:^|[^A-Za-z0-9])(N\s?-?\s?S|[EO]\s?-?\s?W|E-O|U\s?-?\s?D|[NS]\d{2,3}[EW]|north-?south|east-?west|nord-?sud|ost-?west|est-?ouest"
    r"|verti[ck]ale?|longitudinale?|trans?vers\w*)(?![A-Za-z0-9])"
    r"|\b(?:comp(?:onent)?|chan(?:nel)?|komponente|composante|componente)\b\.?\s*[:=#]?\s*([A-Za-z0-9][\w-]*)",
    re.IGNORECASE,
)
