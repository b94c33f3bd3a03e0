"""MATLAB files: what can be read is read, and what is left out is named; objects come with their own clocks."""

from __future__ import annotations

import io
import subprocess
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest
import scipy.io
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.laboratory import matlab, matlab73, matlab_objects
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, checked
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import matlab5
from tests.engine.formats.writers.matlab5 import Object

X = 12.5 * np.sin(np.arange(400) / 9)
FORCE = {"data": X, "dt": 0.004, "units": "kN", "scale": 2.0, "t0": 0.5}


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.mat", "matlab")


@pytest.mark.parametrize("compressed", [False, True])
def test_an_object_beside_arrays_is_named_and_the_arrays_are_read(compressed: bool) -> None:
    table = read(matlab5.file({"t": X, "note": Object("string"), "force": FORCE}, compressed))
    assert list(table.names) == ["t", "force"]
    force = table.names["force"]
    np.testing.assert_array_equal(force.values, 2 * X)
    assert (force.unit, force.dt, force.start, force.applied) == ("kN", 0.004, 0.5, "stored value x 2 (scale)")
    assert any(note.startswith("note (an object of MATLAB's class string)") for note in table.notes)


def test_a_damaged_variable_is_named_and_the_others_are_read() -> None:
    broken = bytearray(matlab5.element("b", X, compressed=True))
    broken[40:60] = bytes(20)
    table = read(matlab5.file({"a": X}) + bytes(broken) + matlab5.element("c", X))
    assert list(table.names) == ["a", "c"]
    assert "cannot be read" in table.notes[0] and "left out" in table.notes[0]


def test_a_cut_file_is_refused_with_both_lengths() -> None:
    raw = matlab5.file({"a": X, "b": X})
    with pytest.raises(FileError, match="a variable states 3248 bytes; the file has 3148"):
        read(raw[:-100])
    whole = len(matlab5.file({"a": X}))
    for cut in range(140, len(raw), 311):
        assert cut == whole or binaries.read_or_refused(matlab.read, raw[:cut], "a.mat") is None


def test_without_the_extra_the_note_names_it(tmp_path: Path) -> None:
    (tmp_path / "a.mat").write_bytes(matlab5.file({"a": X, "t": Object("timetable")}))
    code = (
        "import sys; sys.modules['matio'] = None\n"
        "from pathlib import Path\nfrom rths_engine.formats.laboratory import matlab\n"
        "from rths_engine.formats.source import Source\n"
        f"print(matlab.read(Source('a.mat', path=Path({str(tmp_path / 'a.mat')!r}))).notes[0])\n"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert told.startswith("t (an object of MATLAB's class timetable) is left out; to read it: .venv/bin/pip install")


def test_cells_and_struct_arrays_by_scipy() -> None:
    cell = np.empty((1, 2), dtype=object)
    cell[0, 0], cell[0, 1] = X, X[:50]
    signals = np.array(
        [("force", X, "kN"), ("disp", X / 2, "mm")], dtype=[("name", object), ("data", object), ("unit", object)]
    )
    buffer = io.BytesIO()
    scipy.io.savemat(buffer, {"c": cell, "signals": signals})
    table = read(buffer.getvalue())
    assert [(one.name, one.unit, len(one.values)) for one in table.columns] == [
        ("c/1", "", 400),
        ("c/2", "", 50),
        ("force", "kN", 400),
        ("disp", "mm", 400),
    ]


@settings(max_examples=30)
@given(
    st.dictionaries(
        st.from_regex(r"[a-z]{1,12}", fullmatch=True), st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=40), min_size=1
    ),
    st.booleans(),
)
def test_any_written_file_gives_its_values_back(variables: dict[str, list[float]], compressed: bool) -> None:
    written = {f"v_{name}": values for name, values in variables.items()}
    table = read(matlab5.file(written, compressed))
    assert {one.name: one.values.tolist() for one in table.columns} == written


RAW = matlab5.file({"a": X[:40], "s": FORCE | {"data": X[:40]}, "o": Object()})


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(130, 10**9), st.integers(0, 255)), max_size=4), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    try:
        registry.read(Source("a.mat", content=binaries.damaged(RAW, changes, cut)), format="matlab")
    except FileError as refusal:
        assert refusal.issues


def matlab73_file(variables: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        refs = file.create_group("#refs#")

        def put(group: h5py.Group, name: str, value: Any) -> None:
            if isinstance(value, dict):
                item = group.create_group(name)
                item.attrs["MATLAB_class"] = np.bytes_(b"struct")
                for key, one in value.items():
                    put(item, key, one)
            elif isinstance(value, str):
                item = group.create_dataset(name, data=np.array([[ord(one)] for one in value], dtype="u2"))
                item.attrs["MATLAB_class"] = np.bytes_(b"char")
            elif isinstance(value, list):
                for one in value:
                    put(refs, f"r{len(refs)}", one)
                places = [refs[f"r{k}"].ref for k in range(len(refs) - len(value), len(refs))]
                item = group.create_dataset(name, data=np.array([places], dtype=h5py.ref_dtype), dtype=h5py.ref_dtype)
                item.attrs["MATLAB_class"] = np.bytes_(b"cell")
            elif isinstance(value, Object):
                item = group.create_dataset(name, data=np.array([[0xDD000000, 2, 1, 1, 1, 1]], dtype="u4"))
                item.attrs["MATLAB_class"] = np.bytes_(value.of_class.encode())
                item.attrs["MATLAB_object_decode"] = np.int32(3)
            else:
                item = group.create_dataset(name, data=np.atleast_2d(np.asarray(value)).T)
                item.attrs["MATLAB_class"] = np.bytes_(b"double")

        for name, value in variables.items():
            put(file, name, value)
    raw = bytearray(buffer.getvalue())
    raw[:116] = b"MATLAB 7.3 MAT-file".ljust(116)
    return bytes(raw)


def test_version_7_3_gives_structs_cells_and_texts_and_names_objects() -> None:
    raw = matlab73_file({"force": FORCE, "c": [X, X[:50]], "o": Object("timetable")})
    table = binaries.read(raw, "a.mat", "matlab73")
    force = table.names["force"]
    np.testing.assert_array_equal(force.values, 2 * X)
    assert (force.unit, force.dt, force.start) == ("kN", 0.004, 0.5)
    assert [len(table.names[name].values) for name in ("c/1", "c/2")] == [400, 50]
    assert any(note.startswith("o (an object of MATLAB's class timetable)") for note in table.notes)
    assert checked(matlab73.read(Source("a.mat", content=raw))).format == "MATLAB v7.3"


def objects(value: Any) -> matlab_objects.Found:
    found = matlab_objects.Found()
    matlab_objects._plain("x", value, found, 12)
    return found


def an_object(of_class: str, **properties: Any) -> Any:
    return SimpleNamespace(classname=of_class, properties=properties)


def text(value: str) -> Any:
    return np.array([value]) if value else np.array([], dtype="<U1")


def series(values: Any, times: Any, unit: str = "kN", of_time: str = "seconds", length: int | None = None) -> Any:
    none, count = np.zeros((0, 0)), np.array([[len(times) if length is None else length]])
    about = {"Units": text(of_time), "Time_": np.reshape(times, (-1, 1)), "Length": count, "Increment_": none, "Start_": none}
    properties = {"Data_": np.asarray(values), "TimeInfo": an_object("tsdata.timemetadata", **about), "Storage_": none}
    return an_object("timeseries", Name=text("x"), DataInfo=an_object("tsdata.datametadata", Units=text(unit)), **properties)


def test_a_time_series_has_the_step_of_its_own_times() -> None:
    (column,) = objects(series(X.reshape(-1, 1), 250 + 4 * np.arange(400), of_time="milliseconds")).columns
    assert (column.name, column.unit, column.start) == ("x", "kN", 0.25) and column.dt == pytest.approx(0.004)
    stamps, uneven = objects(series(X.reshape(1, -1), np.arange(400) ** 1.1)).columns
    assert uneven.time == stamps.name == "x/Time"
    matrices = objects(series(np.arange(24.0).reshape(2, 3, 4), [0, 1, 2, 3])).columns
    assert [one.values.tolist() for one in matrices][:2] == [[0, 1, 2, 3], [12, 13, 14, 15]]  # elements (1,1) and (2,1)
    assert not objects(series(X, np.arange(399), length=400)).statements[0].agrees


def timetable(rows: Any, **about: Any) -> Any:
    cells = np.empty((1, 1), dtype=object)
    cells[0, 0] = X.reshape(-1, 1)
    names, units, dimensions = (np.empty((1, 1), dtype=object) for _ in range(3))
    names[0, 0], units[0, 0], dimensions[0, 0] = text("force"), text("kN"), text("Time")
    content = {
        "data": cells,
        "varNames": names,
        "varUnits": units,
        "dimNames": dimensions,
        "numRows": np.array([[400.0]]),
        "rowTimes": rows,
    }
    record = np.empty((1, 1), dtype=[(key, object) for key in content])
    for key, value in {**content, **about}.items():
        record[key][0, 0] = value
    return an_object("timetable", any=record)


def test_a_timetable_keeps_steps_below_a_second() -> None:
    (column,) = objects(timetable(an_object("duration", millis=4.0 * np.arange(400).reshape(-1, 1)))).columns
    np.testing.assert_array_equal(column.values, X)
    assert (column.name, column.unit) == ("x/force", "kN") and column.dt == pytest.approx(0.004)
    rate = np.empty((1, 1), dtype=[(key, object) for key in ("origin", "stepSize", "sampleRate", "specifiedAsRate")])
    rate["origin"][0, 0], rate["stepSize"][0, 0] = (an_object("duration", millis=np.array([[one]])) for one in (1500.0, 4.0))
    rate["sampleRate"][0, 0], rate["specifiedAsRate"][0, 0] = np.array([[250.0]]), np.array([[True]])
    (column,) = objects(timetable(rate)).columns
    assert (column.dt, column.start) == (0.004, 1.5)
    assert not objects(timetable(rate, numRows=np.array([[401.0]]))).statements[0].agrees


def test_tables_and_time_series_written_by_matio_come_back(tmp_path: Path) -> None:
    matio, pandas = pytest.importorskip("matio"), pytest.importorskip("pandas")
    times = pandas.to_timedelta(np.arange(400) * 4, unit="ms").as_unit("ms")
    frame = pandas.DataFrame({"force": X}, index=pandas.TimedeltaIndex(times, name="Time"))
    for version, key in (("v7", "matlab"), ("v7.3", "matlab73")):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            matio.save_to_mat(str(tmp_path / "a.mat"), {"run": frame, "plain": X}, version=version)
        table = binaries.read((tmp_path / "a.mat").read_bytes(), "a.mat", key)
        column = table.names["run/force"]
        np.testing.assert_array_equal(column.values, X)
        assert column.dt == pytest.approx(0.004) and "plain" in table.names
