"""`rths import`: import a file of measurements as a recording by a mapping, or propose a mapping for the file."""

from __future__ import annotations

import hashlib
import sys
from argparse import Namespace
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from app.cli import many, mapping_file
from app.cli.run_input import check_folder
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings import measured
from rths_engine.recordings.measured import Measured, MeasuredChannel, mapping_yaml
from rths_engine.recordings.measured.roles import shown


def measurements(given: Namespace) -> int | None:
    """`rths import`: import a file or many files, or print a proposed mapping. Raises MeasuredError for an invalid input."""
    if many.asked(given.file):
        return many.measurements(given)
    if given.table is not None or given.trust_mapping:
        raise MeasuredError(Issue("--table and --trust-mapping", "need a folder or a .zip of files", str(given.file)))
    if given.guess == (given.map is not None) or given.guess == (given.out is not None):
        raise MeasuredError(Issue("", "needs either --guess, or --map MAP.yaml and --out REC.h5"))
    content, checksum = _content(given.file)
    table = measured.read(content, given.file.name)
    if given.guess:
        try:
            found = measured.guess(table)
        except MeasuredError as error:
            print(mapping_yaml.to_complete(table), end="")
            print(f"no mapping is proposed: {error}; its columns are listed to complete", file=sys.stderr)
            return None
        print(mapping_yaml.write(found.mapping, found.reasons, found.left_out), end="")
        for note in found.notes:
            print(f"# {note}")
        return None
    check_folder(given.out, "--out", "rec.h5")
    if given.out.exists() and given.out.samefile(given.file):
        raise MeasuredError(Issue("--out", "is the file of measurements itself", str(given.out), "choose another file"))
    mapping = mapping_file.mapping(given.map)
    recording = measured.imported(table, mapping, str(given.file.resolve()), checksum())
    try:
        measured.save(given.out, recording, durable=False)  # the file of measurements remains
    except OSError as error:
        raise MeasuredError(
            Issue("--out", f"was not written: {error.strerror}", str(given.out), "choose another file")
        ) from None
    for warning in recording.warnings:
        print(warning, file=sys.stderr)
    print(_report(given.out, recording))
    return None


def _content(path: Path) -> tuple[Path | bytes, Callable[[], str]]:
    """What to read the measurements from, and a function that gives their checksum, computed while they are read."""
    if not path.is_file():
        raw = mapping_file.content(path, "FILE")  # a pipe
        return raw, lambda: hashlib.sha256(raw).hexdigest()
    try:
        path.open("rb").close()
    except OSError as error:
        raise MeasuredError(Issue("FILE", f"cannot be read: {error.strerror}", str(path))) from None
    with_reading = ThreadPoolExecutor(1)
    checksum = with_reading.submit(files.checksum, path)
    with_reading.shutdown(wait=False)
    return path, checksum.result


def _report(path: Path, recording: Measured) -> str:
    duration = (recording.samples - 1) * recording.dt
    head = f"{path}: {recording.samples} samples at {1 / recording.dt:g} Hz, {duration:g} s"
    return "\n".join([head, *(_line(channel) for channel in recording.channels)])


def _line(channel: MeasuredChannel) -> str:
    extent = measured.extent(channel.values)
    (low, high), unit = shown(np.array([extent.low, extent.high]), channel.unit)
    span = f"{low:>10.4g} to {high:>10.4g} {unit:<6}"
    return f"  {channel.key:<12} {span} {channel.label} (column {channel.column})"
