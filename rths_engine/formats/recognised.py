"""Formats that are recognised by their content but not read: the error names the format and how to export the file."""

from __future__ import annotations

from rths_engine.formats.source import Source
from rths_engine.foundation.errors import FileError, Issue

# first bytes -> what the file is, and how to get its numbers
_SIGNATURES = (
    (b"%PDF", "is a PDF document", "export the numbers as text or CSV"),
    (b"\x1f\x8b", "is compressed (gzip)", "decompress it first"),
    (b"PK\x03\x04", "is a ZIP archive", "import its files, or unpack it first"),
    (b"MULTI_STREAM_FILE_VER", "is a Dewesoft file (.dxd, .d7d)", "export it from Dewesoft as UFF 58, MAT or CSV"),
    (b"FORMAT\0", "is an RPC III file (.rsp, .tim)", "export its channels as UFF 58 or ASCII"),
    (b'"TOB1"', "is a Campbell TOB1 file", "convert it with CardConvert to TOA5"),
    (b'"TOB3"', "is a Campbell TOB3 file", "convert it with CardConvert to TOA5"),
    (b"\xd0\xcf\x11\xe0", "is an old Office document (OLE), such as .doc", "export the numbers as .xlsx or CSV"),
)
# first bytes of text, likewise
_TEXTS = (
    (b'"TOACI1"', "is a Campbell TOACI1 file, which states no units", "export it as TOA5"),
    (
        b"Response and Fourier amplitude spectra",
        "contains response spectra (CSMIP volume 3), not a record",
        "give the corrected record (volume 2, .V2)",
    ),
)
_DIADEM = ("is the index of a DIAdem file (.tdm), whose numbers are in a .tdx file", "save it in DIAdem as TDMS or CSV")


def rows() -> list[tuple[str, str]]:
    """What each such file is, and how to get its numbers."""
    return [(problem, fix) for _, problem, fix in (*_SIGNATURES, *_TEXTS)] + [_DIADEM]


def refuse(source: Source) -> None:
    """Raises FileError where the file is of a format that is not read."""
    for signature, problem, fix in _SIGNATURES:
        if source.head.startswith(signature):
            told = f"{problem}, which is binary and not read here"
            raise FileError(Issue("file", told, fix=f"{fix}, or give the record as text"))
    for signature, problem, fix in _TEXTS:
        if source.head.lstrip().startswith(signature):
            raise FileError(Issue("file", problem, fix=fix))
    if b"<usi:tdm" in source.head:
        raise FileError(Issue("file", _DIADEM[0], fix=_DIADEM[1]))
