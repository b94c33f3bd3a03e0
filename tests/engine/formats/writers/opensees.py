"""Recorders of OpenSees: text with six digits, XML with a response for each column, rows of float64 with a line feed."""

from __future__ import annotations

import struct
from collections.abc import Sequence

Rows = Sequence[Sequence[float]]


def text(rows: Rows) -> bytes:
    return "".join(" ".join(f"{one:.6g}" for one in row) + "\n" for row in rows).encode()


def binary(rows: Rows) -> bytes:
    return b"".join(struct.pack(f"<{len(row)}d", *row) + b"\n" for row in rows)


def xml(rows: Rows, nodes: Sequence[int], dofs: Sequence[int] = (1,), response: str = "D") -> bytes:
    outputs = [
        f'    <NodeOutput nodeTag="{node}" coord1="0" coord2="0" coord3="0">\n'
        + "".join(f"        <ResponseType>{response}{dof}</ResponseType>\n" for dof in dofs)
        + "    </NodeOutput>\n"
        for node in nodes
    ]
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n <OpenSees\n'
        '  xmlns:xsi = "http://www.w3.org/2001/XMLSchema-instance"\n'
        '  xsi:noNamespaceSchemaLocation = "http://OpenSees.berkeley.edu/xml-schema/xmlns/OpenSees.xsd">\n'
        "    <TimeOutput>\n        <ResponseType>time</ResponseType>\n    </TimeOutput>\n"
        + "".join(outputs)
        + "    <Data>\n"
        + "".join("        " + " ".join(f"{one:.6g}" for one in row) + " \n" for row in rows)
        + "        </Data>\n</OpenSees>\n"
    ).encode()
