"""The documents of the program as pages: Markdown rendered to HTML whose links lead to other pages of the help."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token

from app.problems import NotFound

ROOT = Path(__file__).parents[2]
LOOSE = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")
COMMENT = re.compile(r"<!--.*?-->\n?", re.DOTALL)
PICTURES = {".png": "image/png", ".svg": "image/svg+xml"}
ADDRESS = "/help/"


@dataclass(frozen=True, slots=True)
class Section:
    """A part of a document under one heading: the document's path, the heading with its anchor, and the text."""

    document: str
    heading: str
    anchor: str
    text: str


def paths() -> list[str]:
    """The documents, as paths from the project's folder."""
    return [*LOOSE, *sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md"))]


def pictures() -> list[str]:
    """The pictures in the documents, as paths from the project's folder."""
    folders = (ROOT / "docs", ROOT / "benchmarks")
    return [path.relative_to(ROOT).as_posix() for folder in folders for path in folder.glob("*.*") if path.suffix in PICTURES]


def picture(name: str) -> tuple[Path, str]:
    """The file and the media type of a picture. Raises NotFound."""
    if name not in pictures():
        raise NotFound(f"There is no picture {name}.")
    path = ROOT / name
    return path, PICTURES[path.suffix]


@cache
def html(name: str) -> str:
    """A document as HTML. Raises NotFound."""
    tokens = _tokens(name)
    text: str = _markdown().renderer.render(tokens, _markdown().options, {})
    return text


def title(name: str) -> str:
    """The first heading of a document. Raises NotFound."""
    return next((section.heading for section in sections(name) if section.heading), name)


@cache
def sections(name: str) -> Sequence[Section]:
    """The parts of a document, each under its heading. Raises NotFound."""
    return list(_sections(name, _tokens(name)))


def _sections(name: str, tokens: list[Token]) -> Iterator[Section]:
    heading, anchor, text = "", "", list[str]()
    for index, token in enumerate(tokens):
        if token.type == "heading_open":
            if text or heading:
                yield Section(name, heading, anchor, " ".join(text))
            heading, anchor, text = _plain(tokens[index + 1]), str(token.attrs.get("id", "")), []
        elif token.type in {"inline", "fence", "code_block"} and tokens[index - 1].type != "heading_open":
            text.append(_plain(token))
    yield Section(name, heading, anchor, " ".join(text))


def _plain(token: Token) -> str:
    """The text of a token without its marks."""
    if token.children is None:
        return token.content
    words = {"text", "code_inline"}
    return "".join(child.content if child.type in words else " " * (child.type == "softbreak") for child in token.children)


@cache
def _markdown() -> MarkdownIt:
    return MarkdownIt("commonmark", {"html": False}).enable("table")


def _tokens(name: str) -> list[Token]:
    if name not in paths():
        raise NotFound(f"There is no document {name}.")
    tokens = _markdown().parse(COMMENT.sub("", (ROOT / name).read_text(encoding="utf-8")))
    anchors: set[str] = set()
    for index, token in enumerate(tokens):
        if token.type == "heading_open":
            token.attrSet("id", _anchor(_plain(tokens[index + 1]), anchors))
        if token.type == "table_open":
            token.attrSet("tabindex", "0")  # a wide table scrolls
        if "style" in token.attrs:  # the alignment of a column, which the pages' security policy does not allow
            del token.attrs["style"]
        for child in token.children or []:
            _lead(child, posixpath.dirname(name))
    return tokens


def _anchor(heading: str, taken: set[str]) -> str:
    """A heading as an anchor, in the way of code hosts: lower case, words joined by hyphens."""
    base = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
    anchor, n = base, 0
    while anchor in taken:
        n += 1
        anchor = f"{base}-{n}"
    taken.add(anchor)
    return anchor


def _lead(token: Token, folder: str) -> None:
    """Lead a link or a picture to the pages of the help. A link to another file of the project loses its address."""
    name: Any = "href" if token.type == "link_open" else "src" if token.type == "image" else None
    address = str(token.attrs.get(name, "")) if name else ""
    if not address or "://" in address or address.startswith("#"):
        return
    path, _, anchor = address.partition("#")
    inside = posixpath.normpath(posixpath.join(folder, path))
    if inside in paths() or inside in pictures():
        token.attrSet(name, ADDRESS + inside + (f"#{anchor}" if anchor else ""))
    else:
        del token.attrs[name]
