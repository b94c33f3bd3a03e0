"""The logo of the laboratory: which images are accepted.

A logo is only ever shown as an image, so that a script in it does not run. An SVG with scripts, embedded pages or references to
other files is refused all the same: a report is passed on, and the next program may open the image by itself.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from defusedxml import ElementTree
from defusedxml.common import DefusedXmlException

from rths_engine.foundation.errors import Issue, RthsError

LARGEST = 200_000  # bytes: a report embeds the logo and stays below 1 MB; see docs/decisions/0047
MOST_PIXELS = 2000  # on each side
PNG, SVG = "image/png", "image/svg+xml"
ENDINGS = {PNG: "png", SVG: "svg"}
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_REFUSED = {"script", "foreignobject", "iframe", "object", "embed", "image", "use", "animate", "set", "a"}
_FIX = "save the logo as a plain PNG or SVG image of at most 200 kB"


@dataclass(frozen=True, slots=True)
class Image:
    """The bytes of an image and its media type."""

    data: bytes
    media_type: str

    @property
    def ending(self) -> str:
        return ENDINGS[self.media_type]


def checked(data: bytes) -> Image:
    """The image of an uploaded logo. Raises RthsError where it cannot be the logo."""
    if not data:
        raise _refused("is empty")
    if len(data) > LARGEST:
        raise _refused(f"is too large: {len(data) / 1000:.0f} kB, and at most {LARGEST // 1000} kB are accepted")
    return _png(data) if data.startswith(_SIGNATURE) else _svg(data)


def _png(data: bytes) -> Image:
    if len(data) < 33 or data[12:16] != b"IHDR":
        raise _refused("is not a complete PNG image")
    width, height = struct.unpack(">II", data[16:24])
    if not (1 <= width <= MOST_PIXELS and 1 <= height <= MOST_PIXELS):
        raise _refused(f"has {width} × {height} pixels, and 1 to {MOST_PIXELS} pixels on each side are accepted")
    return Image(data, PNG)


def _svg(data: bytes) -> Image:
    try:
        root = ElementTree.fromstring(data, forbid_dtd=True)
    except DefusedXmlException:
        raise _refused("has a document type declaration, which can hide other content; delete it") from None
    except (ElementTree.ParseError, ValueError, LookupError):
        raise _refused("is neither a PNG nor an SVG image") from None
    if _name(root.tag) != "svg":
        raise _refused("is not an SVG image: its outermost element is not <svg>")
    for element in root.iter():
        if not isinstance(element.tag, str):
            continue
        name = _name(element.tag)
        if name in _REFUSED:
            raise _refused(f"has an element <{name}>, which is not drawn by itself")
        if name == "style" and ("@import" in (element.text or "") or "url(" in (element.text or "")):
            raise _refused("has a style sheet that refers to another file")
        for attribute, value in element.attrib.items():
            _check(_name(attribute), value)
    return Image(data, SVG)


def _check(attribute: str, value: str) -> None:
    if attribute.startswith("on"):
        raise _refused(f"has a script in its attribute {attribute}")
    local = value.strip().startswith("#")
    if attribute == "href" and not local:
        raise _refused("refers to another file by its attribute href")
    if "url(" in value.replace(" ", "").lower() and "url(#" not in value.replace(" ", "").replace("'", "").replace('"', ""):
        raise _refused(f"refers to another file by its attribute {attribute}")


def _name(tag: str) -> str:
    return tag.rpartition("}")[2].lower()


def _refused(problem: str) -> RthsError:
    return RthsError(Issue("logo", problem, fix=_FIX))
