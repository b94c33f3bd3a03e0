"""The intermediate model of a report: blocks of text, facts, tables and figures, in sections.

Every report is described once as a `Document`; HTML and PDF are two ways to print it. All text is for people and has its units.
`Panel`s are figures as data (`figures.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from app.reports.figures import Panel

Pairs: TypeAlias = "Sequence[tuple[str, str]]"


@dataclass(frozen=True, slots=True)
class Facts:
    """Labels with their values. `long` values take the whole width."""

    rows: Pairs
    long: bool = False


@dataclass(frozen=True, slots=True)
class Head:
    """The heading of a column; `number` columns are aligned to the right. `share` is the part of the width that it takes."""

    label: str
    number: bool = False
    share: float = 1.0


@dataclass(frozen=True, slots=True)
class Table:
    """A table whose rows begin with their heading. `whole` takes the full width; a `bare` table hides its row of headings."""

    caption: str
    heads: Sequence[Head]
    rows: Sequence[Sequence[str]]
    whole: bool = True
    bare: bool = False


@dataclass(frozen=True, slots=True)
class Heading:
    """The heading of a part of a section."""

    title: str


@dataclass(frozen=True, slots=True)
class Tables:
    """Small tables side by side."""

    tables: Sequence[Table]


@dataclass(frozen=True, slots=True)
class Text:
    """Paragraphs. A `tone` of note is smaller."""

    paragraphs: Sequence[str]
    tone: str = ""


@dataclass(frozen=True, slots=True)
class Figures:
    """Figures in two columns; wide ones take both."""

    panels: Sequence[Panel]


@dataclass(frozen=True, slots=True)
class Signatures:
    """A line for name, signature and date of each role."""

    roles: Sequence[str]


Block: TypeAlias = "Facts | Heading | Table | Tables | Text | Figures | Signatures"


@dataclass(frozen=True, slots=True)
class Section:
    """A heading with its blocks. `together` keeps it on one page."""

    title: str
    blocks: Sequence[Block]
    together: bool = False


@dataclass(frozen=True, slots=True)
class Verdict:
    """The sentence at the head of a report: `lead` is emphasised, `tone` is good, bad or empty."""

    text: str
    lead: str = ""
    tone: str = ""


@dataclass(frozen=True, slots=True)
class Letterhead:
    """Name, address and logo (bytes and media type) of the laboratory."""

    name: str = ""
    address: str = ""
    logo: tuple[bytes, str] | None = None


@dataclass(frozen=True, slots=True)
class Document:
    """A report. `subject` names it in the foot of every page; `made` says when and by which software it was made."""

    kind: str
    title: str
    verdict: Verdict
    facts: Pairs
    sections: Sequence[Section]
    subject: str
    made: str
    further: Sequence[str] = ()
    letterhead: Letterhead = field(default_factory=Letterhead)

    @property
    def panels(self) -> list[Panel]:
        """Every figure, in order."""
        blocks = [block for section in self.sections for block in section.blocks]
        return [panel for block in blocks if isinstance(block, Figures) for panel in block.panels]
