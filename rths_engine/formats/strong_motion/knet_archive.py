"""K-NET and KiK-net as NIED delivers them: a tar archive, also compressed, with a file for each direction of each station."""

from __future__ import annotations

import io
import tarfile
from collections.abc import Iterator
from dataclasses import replace

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.strong_motion import knet
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, Issue

_GZIP, _TAR = b"\x1f\x8b", b"ustar"
_TAR_AT = 257  # by definition of the tar format
# chosen; see docs/decisions/0023
_LARGEST = 200_000_000  # bytes of all files in an archive
_LOOKED_AT = 20  # files of an archive, of which one must be of K-NET or KiK-net


def looks_like(source: Source) -> bool:
    """Whether the file is an archive with a file of K-NET or KiK-net among its first."""
    if not source.head.startswith(_GZIP) and source.head[_TAR_AT : _TAR_AT + len(_TAR)] != _TAR:
        return False
    try:
        for number, (_, member) in enumerate(_members(source)):
            if knet.looks_like(member):
                return True
            if number >= _LOOKED_AT:
                return False
    except FileError:
        pass
    return False


def read(source: Source) -> Table:
    """The records of all files in the archive. Raises FileError with the name of the file that cannot be read."""
    records: list[knet.Record] = []
    notes: list[str] = []
    for name, member in _members(source):
        if not knet.looks_like(member):
            notes.append(f"{name} left out: it is not of K-NET or KiK-net")
            continue
        try:
            found = knet.records(member)
        except FileError as error:
            raise FileError(replace(one, where=_inside(name, one.where)) for one in error.issues) from None
        for record in found:
            stated = [replace(one, where=_inside(name, one.where)) for one in record.statements]
            records.append(replace(record, statements=stated))
    if not records:
        raise FileError(Issue("file", "contains no file of K-NET or KiK-net", fix="unpack it and import its files"))
    return knet.table(records, tuple(notes))


def _inside(name: str, where: str) -> str:
    """A place in a file of the archive; not `line`, which is a line of the archive itself."""
    return f"{name}, {where.replace('line ', 'row ')}"


def _members(source: Source) -> Iterator[tuple[str, Source]]:
    """The files of an archive by name. Raises FileError for a damaged archive, and for one larger than the limit."""
    size = 0
    try:
        with tarfile.open(fileobj=io.BytesIO(source.bytes()), mode="r:*") as archive:
            for member in archive:
                size += member.size
                if size > _LARGEST:
                    problem = f"unpacks to more than {_LARGEST:,} bytes"
                    raise FileError(Issue("file", problem, fix="unpack it and import its files"))
                content = archive.extractfile(member) if member.isfile() else None
                if content is not None:
                    raw = content.read()
                    if len(raw) != member.size:
                        raise FileError(Issue(member.name, "is cut", fix="get the archive again"))
                    yield member.name, Source(member.name, content=raw)
    except (tarfile.TarError, OSError, EOFError, ValueError) as error:
        raise FileError(Issue("file", "is not a valid tar archive", str(error), "get it again")) from None


FORMAT = Format(
    key="knet_archive",
    title="Archive of K-NET and KiK-net",
    of="ground motion",
    extensions=("tar.gz", "tar"),
    defined="K-NET ASCII format, NIED Japan, as it is delivered",
    header="the headers of all files; the start of each record counts from the earliest",
    compared="as for each file",
    looks_like=looks_like,
    read=read,
)
