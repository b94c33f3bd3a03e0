"""Damaged files to every reader: a clear refusal or a valid object, in bounded time and memory."""

from __future__ import annotations

import atexit
import io
import json
import re
import shutil
import struct
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from unittest import mock

import h5py
import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from app.laboratory.logo import SVG, checked
from rths_engine.formats import apart, registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, MeasuredError, MotionError, PlanError, RecordingError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.parts.ground_motions import Motion, contents, stored
from rths_engine.parts.ground_motions import read as read_motion
from rths_engine.planning import plan_yaml, templates
from rths_engine.planning.examples import EXAMPLES
from rths_engine.planning.reading import model_from_yaml, plan_to_yaml
from rths_engine.recordings import opening, run_file
from rths_engine.recordings.batches.archive import Archive, Limits
from rths_engine.recordings.measured import examine, guess, imported, mapping_yaml, store
from rths_engine.recordings.measured.mapping import Mapping
from rths_engine.running.run import simulate
from rths_engine.sweeps.design import read_design
from tests.engine import measurements, plans
from tests.fuzz import trying
from tests.fuzz.mutations import damaged
from tests.fuzz.seeds import SEEDS

TEXTS = ("lvm", "catman-ascii", "mts", "toa5", "tracerdaq", "opensees-xml", "opensees-text", "columns", "record")
_ERROR = re.compile(r"cannot be read as [^:]+: (\w+(?:Error|Warning))\b")
PATIENCE_S = 8.0  # for a library that a damaged file holds for ever; it is then refused


@dataclass(frozen=True)
class Reader:
    """What a reader is given, how it reads, and the errors that it declares."""

    made: SearchStrategy[bytes]
    read: Callable[[bytes], str | None]
    declared: tuple[type[RthsError], ...]
    by_library: bool = True  # whose errors reach the refusal


def faults(name: str, examples: int, seed: int) -> Iterator[str]:
    """What is wrong with a reader over `examples` damaged files."""
    reader = READERS[name]()
    with mock.patch.object(apart, "PATIENCE_S", PATIENCE_S):
        yield from trying.faults(reader.made, lambda raw: _refused_or(reader, raw), examples, seed)


def _refused_or(reader: Reader, raw: bytes) -> str | None:
    try:
        return reader.read(raw)
    except reader.declared as error:
        if not error.issues or not all(one.problem for one in error.issues):
            return f"a refusal without a reason: {error!r}"
        if not reader.by_library and (found := _ERROR.search(str(error))):
            return f"a refusal by {found[0]}: {error} {raw[:2000]!r}"
        return None if len(str(error)) < 200_000 else f"a refusal of {len(str(error))} characters:"


def _of_format(key: str) -> Reader:
    name, make = SEEDS[key]
    one = registry.BY_KEY[key]

    def read(raw: bytes) -> str | None:
        source = Source(name, content=raw)
        table = registry.read(source, registry.RECORD if key == "record" else registry.COLUMNS)
        return wrong_table(table) or (None if one.of == "ground motion" else _measured(table)) or _motion(raw, name, table)

    own = (not one.library and one.read.__module__.startswith("rths_engine.formats.strong_motion")) or key in TEXTS
    return Reader(damaged(make()), read, (FileError,), by_library=not own)


def wrong_table(table: Table) -> str | None:
    """What of a table is not as its declaration promises."""
    for column in table.columns:
        if np.ndim(column.values) != 1 or column.values.dtype.kind != "f":
            return f"a column that is not a row of numbers: {column.name} {column.values.dtype}"
        if column.dt is not None and not (np.isfinite(column.dt) and column.dt > 0):
            return f"a step that is not above 0: {column.name} {column.dt}"
        if not np.isfinite(column.start):
            return f"a start that is not finite: {column.name} {column.start}"
    return None


def _measured(table: Table) -> str | None:
    """Guess the mapping of a table, and import it."""
    try:
        found = imported(table, guess(table).mapping)
    except MeasuredError as error:
        return None if error.issues else "a refusal of an import without a reason:"
    lengths = {len(one.values) for one in found.channels}
    if len(lengths) != 1 or not (np.isfinite(found.dt) and found.dt > 0 and np.isfinite(found.start)):
        return f"an import with channels of {lengths} samples and the step {found.dt}:"
    return None if all(np.isfinite(one.values).all() for one in found.channels) else "an import that is not finite:"


def _motion(raw: bytes, name: str, table: Table) -> str | None:
    """Read the first ground motion of a file, where it has one."""
    try:
        offered = contents(raw, name).channels
        motion = read_motion(raw, name, channel=1 if offered else None, dt=None if table.columns[0].dt else 0.01)
    except MotionError as error:
        return None if error.issues else "a refusal of a motion without a reason:"
    return _wrong_motion(motion)


def _wrong_motion(motion: Motion) -> str | None:
    right = np.isfinite(motion.acceleration).all() and np.isfinite(motion.dt) and motion.dt > 0 and len(motion.acceleration)
    return None if right else f"a motion that is not finite: dt {motion.dt}"


def _plans() -> Reader:
    texts = [plan_to_yaml(templates.template(name)) for name in EXAMPLES]

    def read(raw: bytes) -> str | None:
        model = model_from_yaml(raw.decode("utf-8", "replace"))
        again = model_from_yaml(plan_to_yaml(model.plan)).plan
        return None if again.digest == model.plan.digest else "a plan that is not the same when it is written and read:"

    return Reader(st.sampled_from(texts).flatmap(lambda text: damaged(text.encode())), read, (PlanError,))


def _mappings() -> Reader:
    text = mapping_yaml.write(validated(Mapping, measurements.mapping(title="Sine")))

    def read(raw: bytes) -> str | None:
        mapping = validated(Mapping, plan_yaml.parse(raw.decode("utf-8", "replace")))
        try:
            examine(_table(), mapping)
        except MeasuredError as error:
            assert error.issues
        return None

    return Reader(damaged(text.encode()), read, (PlanError,))


@cache
def _table() -> Table:
    return registry.read(Source("test.csv", content=measurements.csv()))


def _archives() -> Reader:
    raw = io.BytesIO()
    with zipfile.ZipFile(raw, "w", zipfile.ZIP_DEFLATED) as file:
        for k in range(3):
            file.writestr(f"tests/run{k}.csv", measurements.csv()[:2000])

    def read(given: bytes) -> str | None:
        archive = Archive(io.BytesIO(given), "tests.zip", Limits(files=100, bytes=10**7))
        try:
            for name in archive.names:
                try:
                    with archive.open(name) as stream:
                        while stream.read(1 << 16):
                            pass
                except MeasuredError as error:
                    assert error.issues
        finally:
            archive.close()
        return None

    return Reader(damaged(raw.getvalue()), read, (MeasuredError,))


def _stored_motions() -> Reader:
    folder = _folder()
    motion = read_motion(SEEDS["at2"][1](), SEEDS["at2"][0])
    stored.save(folder, motion)
    path = next(folder.glob("*.npz"))

    def read(raw: bytes) -> str | None:
        path.write_bytes(raw)
        stored.describe(path)
        return _wrong_motion(stored.load(path))

    return Reader(damaged(path.read_bytes()), read, (MotionError,))


_ATTRIBUTES = st.one_of(
    st.sampled_from(["", "{}", "[]", "null", "[1]", '[{"key": 1}]', "NaN", "[" * 2000, '"\\ud800"', "9" * 5000]),
    st.floats(),
    st.integers(-(2**31), 2**63 - 1),
    st.sampled_from([np.zeros(0), np.ones((2, 2)), np.bytes_(b"\xff\xfe"), h5py.Empty("f8")]),
)
_DATA = st.sampled_from(
    [
        np.zeros((0, 3)), np.zeros(5), np.float64(1.0), np.ones((4, 40)), np.ones((2, 2, 2)), np.full((9, 3), np.nan),
        np.array([b"text"]), np.arange(7), np.ones(3, complex), np.ones(4, bool),
    ]
)  # fmt: skip


def _recordings(write: Callable[[Path], None], load: Callable[[Path], Any]) -> Reader:
    """A recording whose parts are taken out or replaced, or that is cut. A checksum finds other damage before it is read."""
    path = _folder() / "recording.h5"
    write(path)
    whole = path.read_bytes()
    with h5py.File(path, "r") as file:
        datasets = list(file)
        attributes = [("/", name) for name in file.attrs]
        attributes += [(one, name) for one in datasets for name in file[one].attrs]

    def changed(which: int, value: Any, lost: bool, of_file: bool) -> bytes:
        path.write_bytes(whole)
        with h5py.File(path, "r+") as file:
            if of_file:
                name = datasets[which % len(datasets)]
                kept = dict(file[name].attrs)
                del file[name]
                if not lost:
                    file.create_dataset(name, data=value if isinstance(value, str) else np.asarray(value)).attrs.update(kept)
            else:
                where, name = attributes[which % len(attributes)]
                del file[where].attrs[name]
                if not lost:
                    file[where].attrs[name] = value
        return path.read_bytes()

    which = st.integers(0, 200)
    made = st.one_of(
        st.builds(changed, which, _ATTRIBUTES, st.just(False), st.just(False)),
        st.builds(changed, which, _DATA, st.booleans(), st.just(True)),
        st.builds(changed, which, st.sampled_from(["{}", "[]", "x", "[" * 2000]), st.just(False), st.just(True)),
        which.map(lambda at: whole[: at * len(whole) // 200]),
    )

    def read(raw: bytes) -> str | None:
        path.write_bytes(raw)
        return _wrong_recording(load(path), path)

    return Reader(made, read, (RecordingError,))


def _wrong_recording(found: Any, path: Path) -> str | None:
    if isinstance(found, run_file.Recording):
        if found.signals.ndim != 2 or found.signals.shape[1] != len(found.channels):
            return f"a recording of {found.signals.shape} samples with {len(found.channels)} channels:"
        list(run_file.rows(path, 100)[2])
        run_file.head(path)
        run_file.chosen(path, [one.key for one in found.channels][:2])
    return None if np.isfinite(found.dt) and found.dt > 0 else f"a recording with the step {found.dt}:"


def _run_file(path: Path) -> None:
    run_file.save(path, simulate(plans.make(plans.building([1e5], [1e7]), plans.quiet(0.05), 0.01)))


def _measured_file(path: Path) -> None:
    store.save(path, imported(_table(), validated(Mapping, measurements.mapping())))


def _sweeps() -> Reader:
    """Definitions of sweeps as a body of a request: damaged JSON that can still be parsed."""
    fields = [
        {"path": "stations.*.compensator.alpha_es", "values": [20, 30]},
        {"path": "structure.damping_ratio", "values": [1, 5], "unit": "%"},
    ]
    whole = {"name": "Trial", "plan": templates.template("two-storeys").as_dict(), "fields": fields}

    def read(raw: bytes) -> str | None:
        try:
            data = json.loads(raw)
        except (ValueError, RecursionError):
            return None
        design = read_design(data)
        values = [value for point in (0, design.count - 1) for value in design.inputs(point)]
        return None if np.isfinite(np.asarray(values, float)).all() else f"a sweep with inputs that are not finite: {values}"

    return Reader(damaged(json.dumps(whole).encode()), read, (RthsError,), by_library=False)


def _logos() -> Reader:
    svg = b'<svg xmlns="http://www.w3.org/2000/svg"><style>.a{fill:red}</style><path class="a" d="M0 0h9"/></svg>'
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBB", 13, b"IHDR", 9, 9, 8, 2, 0, 0, 0) + bytes(12)

    def read(raw: bytes) -> str | None:
        image = checked(raw)
        text = image.data.decode("utf-8", "replace").lower()
        return "an image with a script" if image.media_type == SVG and "<script" in text else None

    return Reader(st.one_of(damaged(svg), damaged(png)), read, (RthsError,))


@cache
def _folder() -> Path:
    """A folder for the files of all readers, removed at the end of the process."""
    folder = Path(tempfile.mkdtemp(prefix="rths-fuzz-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


READERS: dict[str, Callable[[], Reader]] = {
    **{key: lambda key=key: _of_format(key) for key in SEEDS},  # type: ignore[misc]
    "plan": _plans,
    "mapping": _mappings,
    "archive of a batch": _archives,
    "sweep": _sweeps,
    "logo": _logos,
    "stored ground motion": _stored_motions,
    "recording of a run": lambda: _recordings(_run_file, run_file.load),
    "recording, opened": lambda: _recordings(_run_file, opening.load),
    "measured recording": lambda: _recordings(_measured_file, opening.load),
}
