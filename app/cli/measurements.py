"""`rths import`: import a file of measurements as a recording by a mapping, or propose a mapping for the file."""

from __future__ import annotations

import hashlib
import sys
from argparse import Namespace
from pathlib import Path

import numpy as np

from app.cli.run_input import check_folder
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings import measured
from rths_engine.recordings.measured import Mapping, Measured, MeasuredChannel, mapping_yaml
from rths_engine.recordings.measured.roles import shown


def measurements(given: Namespace) -> None:
    """`rths import`: import a file, or print a proposed mapping. Raises MeasuredError for an invalid file or mapping."""
    if given.guess == (given.map is not None) or given.guess == (given.out is not None):
        raise MeasuredError(Issue("", "needs either --guess, or --map MAP.yaml and --out REC.h5"))
    raw = _bytes(given.file, "FILE")
    table = measured.read(raw, given.file.name)
    if given.guess:
        found = measured.guess(table)
        print(mapping_yaml.write(found.mapping, found.reasons, found.left_out), end="")
        for note in found.notes:
            print(f"# {note}")
        return
    check_folder(given.out, "--out", "rec.h5")
    if given.out.exists() and given.out.samefile(given.file):
        raise MeasuredError(Issue("--out", "is the file of measurements itself", str(given.out), "choose another file"))
    mapping = Mapping.from_yaml(_text(given.map))
    recording = measured.imported(table, mapping, str(given.file.resolve()), hashlib.sha256(raw).hexdigest())
    try:
        measured.save(given.out, recording)
    except OSError as error:
        raise MeasuredError(
            Issue("--out", f"was not written: {error.strerror}", str(given.out), "choose another file")
        ) from None
    for warning in recording.warnings:
        print(warning, file=sys.stderr)
    print(_report(given.out, recording))


def _bytes(path: Path, where: str) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise MeasuredError(Issue(where, f"cannot be read: {error.strerror}", str(path))) from None


def _text(path: Path) -> str:
    try:
        return _bytes(path, "--map").decode("utf-8")
    except UnicodeDecodeError:
        fix = "`rths import FILE --guess` prints a proposed mapping"
        raise MeasuredError(Issue("--map", "is not valid UTF-8 text", str(path), fix)) from None


def _report(path: Path, recording: Measured) -> str:
    duration = (recording.samples - 1) * recording.dt
    head = f"{path}: {recording.samples} samples at {1 / recording.dt:g} Hz, {duration:g} s"
    return "\n".join([head, *(_line(channel) for channel in recording.channels)])


def _line(channel: MeasuredChannel) -> str:
    values, unit = shown(channel.values, channel.unit)
    span = f"{np.min(values):>10.4g} to {np.max(values):>10.4g} {unit:<6}"
    return f"  {channel.key:<12} {span} {channel.label} (column {channel.column})"
