"""Which characters no font can draw in a PDF, asked of Typst: it refuses them under PDF/UA-1."""

from __future__ import annotations

import json
import tempfile
from html import escape

PROBE = b"""#set document(title: "Probe")
#set text(font: "Libertinus Serif")  // as in report.typ
#let data = json(bytes(sys.inputs.probe))
#data.text
#image(bytes(data.svg), format: "svg", alt: "Probe")
"""
BOX = "\N{WHITE SQUARE}"
SAID = f"Characters that no font of this PDF has are shown as {BOX}. The HTML report has them."


def lacking(text: str) -> set[str]:
    """The characters of `text` that neither the fonts of Typst nor those of the system draw, in text or in a figure."""
    import typst

    with tempfile.TemporaryDirectory() as empty:
        compiler = typst.Compiler(root=empty)  # finds the fonts once

        def drawn(one: str) -> bool:
            words = f'<text y="9" font-family="Libertinus Serif">{escape(one)}</text>'
            svg = f'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{words}</svg>'
            try:
                inputs = {"probe": json.dumps({"text": one, "svg": svg})}
                compiler.compile(PROBE, format="pdf", sys_inputs=inputs, pdf_standards="ua-1")
            except typst.TypstError:
                return False
            return True

        return {one for one in set(text) if not one.isascii() and not drawn(one)}


def boxed(text: str, characters: set[str]) -> str:
    """The text with a box in place of each of the characters."""
    return text.translate({ord(one): BOX for one in characters})
