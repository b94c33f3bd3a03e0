"""`rths import FOLDER_OR_ZIP`: import many files by one mapping, and print a table of what differs between them."""

from __future__ import annotations

import os
import tempfile
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path, PurePosixPath
from shutil import copyfileobj
from typing import Any

from app.cli import mapping_file
from app.cli.run_input import check_folder
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.batches import Archive, Batch, Item, Limits, listing, run
from rths_engine.recordings.batches.archive import wanted
from rths_engine.recordings.measured import Measured, read, save

ALL, SOME, NONE = 0, 1, 2  # exit codes: how many files were imported
GAP = 2  # characters between the columns of the table
HEADS = ("file", "result", "rate, Hz", "start, s", "duration, s", "samples")


def asked(path: Path) -> bool:
    """Whether the input is a folder or an archive of many files."""
    return path.is_dir() or path.suffix.lower() == ".zip"


def measurements(given: Namespace) -> int:
    """Import every file of a folder or an archive; the exit code says whether all, some or none were imported."""
    if given.guess or given.map is None or given.out is None:
        fix = "`rths import FILE --guess` proposes a mapping for one of the files"
        raise MeasuredError(Issue("", "many files need --map MAP.yaml and --out FOLDER", fix=fix))
    mapping = mapping_file.mapping(given.map)
    if given.table is not None:
        check_folder(given.table, "--table", "table.csv")
    with ExitStack() as stack:
        source = Folder(given.file, given.map) if given.file.is_dir() else Zipped(given.file, stack)
        names = _recordings(source.names)
        out = _folder(given.out, source)
        staged = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix=".import-", dir=out)))
        batch = run(source.items(), mapping, lambda index, _, one: _keep(staged / str(index), one), given.trust_mapping)
        rows = list(_placed(batch, staged, out, names))
    if given.table is not None:
        _write(given.table, listing.to_csv(rows))
    print("\n".join(_lines(batch, rows)))
    return ALL if batch.imported == len(rows) else SOME if batch.imported else NONE


class Folder:
    """The files of a folder and its folders, without the mapping `beside` them. Links to folders are not followed."""

    def __init__(self, folder: Path, beside: Path):
        self.folder = folder
        found = (Path(where) / name for where, _, names in os.walk(folder) for name in names)
        self.paths = {
            path.relative_to(folder).as_posix(): path
            for path in sorted(found)
            if wanted(path.relative_to(folder).as_posix()) and path.is_file() and not path.samefile(beside)
        }
        if not self.paths:
            raise MeasuredError(Issue("FOLDER", "contains no file", str(folder), "choose the folder of the measurements"))
        if len(self.paths) > Limits().files:
            problem = f"contains more than {Limits().files} files"
            raise MeasuredError(Issue("FOLDER", problem, str(len(self.paths)), "import fewer files at a time"))

    @property
    def names(self) -> list[str]:
        return list(self.paths)

    def items(self) -> Iterator[Item]:
        for name, path in self.paths.items():
            yield _item(name, path)


class Zipped:
    """The files of an archive, each unpacked to a temporary file while it is read."""

    def __init__(self, path: Path, stack: ExitStack):
        try:
            file = stack.enter_context(path.open("rb"))
        except OSError as error:
            raise MeasuredError(Issue("FOLDER_OR_ZIP", f"cannot be read: {error.strerror}", str(path))) from None
        self.archive = Archive(file, str(path))
        stack.callback(self.archive.close)

    @property
    def names(self) -> list[str]:
        return self.archive.names

    def items(self) -> Iterator[Item]:
        with tempfile.TemporaryDirectory(prefix="rths-") as folder:
            for name in self.names:
                path = Path(folder) / "unpacked"
                try:
                    with self.archive.open(name) as packed, path.open("wb") as unpacked:
                        copyfileobj(packed, unpacked)
                except MeasuredError as error:
                    yield Item(name, refused=error.issues)
                    continue
                yield _item(name, path)


def _item(name: str, path: Path) -> Item:
    try:
        size, sha256 = path.stat().st_size, files.checksum(path)
    except OSError as error:
        return Item(name, refused=(Issue("file", f"cannot be read: {error.strerror}"),))
    return Item(name, size, sha256, lambda: read(path, name))


def _recordings(names: list[str]) -> dict[str, str]:
    """The name of the recording of each file: folders joined by `_`; the extension stays where two names would be equal."""
    stems = Counter(_stem(name) for name in names)
    chosen = {name: f"{_stem(name) if stems[_stem(name)] == 1 else name.replace('/', '_')}.h5" for name in names}
    for name, count in Counter(chosen.values()).items():
        if count > 1:
            problem = "would give two recordings of one name"
            raise MeasuredError(Issue("FOLDER_OR_ZIP", problem, name, "rename one of the files"))
    return chosen


def _stem(name: str) -> str:
    return PurePosixPath(name).with_suffix("").as_posix().replace("/", "_")


def _folder(out: Path, source: Folder | Zipped) -> Path:
    """The folder for the recordings, made where it does not exist; never the folder of the measurements."""
    if not out.is_dir():
        check_folder(out, "--out", "recordings")
    if out.is_file() or (isinstance(source, Folder) and out.resolve().is_relative_to(source.folder.resolve())):
        problem = "needs a folder outside the folder of measurements"
        raise MeasuredError(Issue("--out", problem, str(out), "choose another folder"))
    try:
        out.mkdir(exist_ok=True)
    except OSError as error:
        raise MeasuredError(Issue("--out", f"was not made: {error.strerror}", str(out), "choose another folder")) from None
    return out


def _keep(path: Path, measured: Measured) -> None:
    try:
        save(path, measured, durable=False)  # the files of measurements remain
    except OSError as error:
        fix = "free disk space, or choose another folder"
        raise MeasuredError(Issue("--out", f"was not written: {error.strerror}", str(path.parent.parent), fix)) from None


def _placed(batch: Batch, staged: Path, out: Path, names: dict[str, str]) -> Iterator[dict[str, Any]]:
    """The rows of the table; the recordings of imported files are moved to the folder for them."""
    for index, row in enumerate(batch.rows):
        if row.imported:
            (staged / str(index)).replace(out / names[row.name])
        yield {**listing.as_dict(row), "recording": str(out / names[row.name]) if row.imported else None}


def _write(path: Path, text: str) -> None:
    try:
        files.write(path, text)
    except OSError as error:
        raise MeasuredError(Issue("--table", f"was not written: {error.strerror}", str(path))) from None


def _lines(batch: Batch, rows: list[dict[str, Any]]) -> Iterator[str]:
    """The table for a terminal: a line for each file, and below it its reasons, differences and number of warnings."""
    cells = [HEADS, *(_cells(row) for row in rows)]
    widths = [max(len(line[at]) for line in cells) for at in range(len(HEADS))]
    yield _line(HEADS, widths)
    for row, line in zip(rows, cells[1:], strict=True):
        yield _line(line, widths)
        for reason in row["reasons"]:
            yield f"    refused: {listing.sentence(reason)}"
        for difference in row["differences"]:
            yield f"    {difference['severity'] if row['imported'] else 'differs'}: {difference['text']}"
        if row["warnings"]:
            count = len(row["warnings"])
            yield f"    {count} warning{'s' if count > 1 else ''} of the checks, stored in the recording"
    yield f"{batch.imported} of {len(rows)} files imported; layout of most files: {batch.reference or 'none'}"


def _cells(row: dict[str, Any]) -> tuple[str, ...]:
    clock = (row[name] for name in ("rate_hz", "start_s", "duration_s", "samples"))
    return (row["file"], "imported" if row["imported"] else "refused", *("–" if one is None else f"{one:.6g}" for one in clock))


def _line(cells: tuple[str, ...], widths: list[int]) -> str:
    first, *others = zip(cells, widths, strict=True)
    return (" " * GAP).join([f"{first[0]:<{first[1]}}", *(f"{cell:>{width}}" for cell, width in others)])
