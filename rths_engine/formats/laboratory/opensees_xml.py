"""XML recorder of OpenSees and OpenFresco: one ResponseType for each column, then rows of numbers between Data tags."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import rows
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.errors import FileError, Issue

UNITLESS = "OpenSees states no units: give the unit of time and of every column"
FIRST_ROW = (
    "without times: the first row is the end of the first step, not time 0; with -dT, rows are whole steps apart, at least dT"
)

_ROOT = re.compile(r"<\s*(Open(?:Sees|Fresco)\w*)")
_DATA, _END = "<Data>", "</Data>"
_TAGS = ("number", "nodeTag", "eleTag", "secTag", "matTag", "tag")  # the attribute that numbers an output
_QUANTITIES = {"D": "displacement", "V": "velocity", "A": "acceleration", "R": "force", "P": "force", "time": "time"}


def looks_like(source: Source) -> bool:
    """Whether the root of the XML text is that of OpenSees or OpenFresco."""
    first = " ".join(source.head_lines[:10])
    return first.lstrip().startswith("<") and _ROOT.search(first) is not None


def read(source: Source) -> Table:
    """The columns of the recorder. Raises FileError with the line where rows and responses differ in number."""
    lines = source.lines
    start = next((k for k, line in enumerate(lines) if line.strip() == _DATA), None)
    end = next((k for k, line in enumerate(lines) if line.strip().startswith(_END)), None)
    if start is None or end is None or end < start:
        fix = "run the analysis to its end, or remove the last line and close the tags"
        raise FileError(Issue("file", f"does not hold its rows between {_DATA} and {_END}: the last row can be cut", fix=fix))
    header = "\n".join(lines[:start])
    found = list(_responses(header))
    names = [name for name, _ in found]
    data = [(k + 1, lines[k].rstrip()) for k in range(start + 1, end) if lines[k].strip()]
    if not found or not data:
        raise FileError(Issue("file", "has no responses or no rows", fix="record at least one response"))
    values, _ = rows.values(data, "", ".", range(len(names)), range(len(names), len(names) + 1), names)
    columns = [
        Column(name, np.ascontiguousarray(values[:, k]), quantity=_QUANTITIES.get(re.sub(r"\d+$", "", response), ""))
        for k, (name, response) in enumerate(found)
    ]
    timed = any(one.quantity == "time" for one in columns)
    return Table(
        "OpenSees recorder (XML)", distinct(columns), notes=(UNITLESS,) if timed else (UNITLESS, FIRST_ROW), header=header
    )


def _responses(header: str) -> Iterator[tuple[str, str]]:
    """Name and response of every column, in the order of the file."""
    root = _ROOT.search(header)
    assert root is not None
    if "<!" in header:
        raise FileError(Issue("file", "has declarations in its XML text, which recorders do not write", fix="record it again"))
    text = re.sub(r"^\s*<\?xml.*?\?>", "", header, flags=re.DOTALL)
    try:
        tree = ElementTree.fromstring(f"{text}</{root[1]}>")
    except ElementTree.ParseError as error:
        raise FileError(Issue("file", f"is not valid XML before its rows: {error}", fix="record it again")) from None
    yield from _below(tree, [])


def _below(node: ElementTree.Element, path: list[str]) -> Iterator[tuple[str, str]]:
    for child in node:
        if child.tag == "ResponseType":
            response = (child.text or "").strip()
            yield (response if response == "time" else " ".join([*path, response])), response
        else:
            yield from _below(child, [*path, _place(child)])


def _place(node: ElementTree.Element) -> str:
    """`node 2` for `<NodeOutput nodeTag="2">`, `uniaxial material 1` for `<UniaxialMaterialOutput matTag="1">`."""
    words = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", node.tag.removesuffix("Output")).lower()
    number = next((node.attrib[key] for key in (*_TAGS, *node.attrib) if key in node.attrib), "")
    return f"{words} {number}".strip()


FORMAT = Format(
    key="opensees-xml",
    title="OpenSees and OpenFresco recorder (XML)",
    of="measurement",
    extensions=("xml", "out"),
    defined="OpenSees, DataFileStream and XmlFileStream",
    header="node or element, material and response of every column; no units: they are asked for",
    compared="number of responses with the fields of every row, end of the rows",
    looks_like=looks_like,
    read=read,
    public=0,
    public_check="two files written by OpenSees 3.7.1, within its six digits of the values that the program returned",
)
