"""Files of measurements in every format come back as what was written; what can't be read is refused with the reason."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import apart
from rths_engine.formats.plain import columns
from rths_engine.formats.table import MOST_SAMPLES
from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings.measured import examine, guess, imported, read
from tests.engine import measurements as made
from tests.engine.measurements import COLUMNS, NAMES, RATE, F, V, X, csv, text

DIGITS = 1e-8  # relative: text is written with nine digits
FORMATS: dict[str, tuple[str, Callable[[], bytes]]] = {
    "CSV": ("test.csv", csv),
    "TSV": ("test.tsv", lambda: text("\t", head=("\t".join(NAMES),))),
    "semicolon and decimal comma": ("test.csv", lambda: text(";", ",", (";".join(NAMES),))),
    "tab and decimal comma": ("test.txt", lambda: text("\t", ",", ("\t".join(NAMES),))),
    "white space and a row of units": ("test.dat", lambda: text("   ", head=("time disp vel force", "s mm mm/s kN"))),
    "comment header": ("test.txt", lambda: text(",", head=("# sine test", "# " + ",".join(NAMES)))),
    "trailing separators": ("test.csv", lambda: text(head=(",".join(NAMES),)).replace(b"\n", b",\r\n") + b",\r\n"),
    "nested JSON": ("test.json", made.json_nested),
    "JSON matrix": ("test.json", made.json_matrix),
    "JSON records": ("test.json", made.json_records),
    "MATLAB v5": ("test.mat", made.matlab5),
    "MATLAB v7.3": ("test.mat", made.matlab73),
    "HDF5": ("test.h5", made.hdf5),
    "Parquet": ("test.parquet", made.parquet),
}


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_read_by_its_guessed_mapping_holds_what_was_written_in_si(format: str) -> None:
    filename, write = FORMATS[format]
    table = read(write(), filename)
    found = imported(table, guess(table).mapping)
    assert found.dt == pytest.approx(1 / RATE, rel=1e-12)
    for role, values, factor in (("x_meas", X, 1e-3), ("v_meas", V, 1e-3), ("f_meas", F, 1e3)):
        np.testing.assert_allclose(found.get(role, 1), factor * values, rtol=DIGITS, atol=DIGITS * factor * 30)


def test_an_at2_record_is_the_ground_acceleration() -> None:
    samples = np.round(0.3 * np.sin(np.arange(400) / 7), 6)
    head = (
        "PEER NGA STRONG MOTION DATABASE RECORD",
        "Event, Station, 0",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        "NPTS= 400, DT= .0050 SEC",
    )
    rows = ("  ".join(f"{number:.6E}" for number in row) for row in samples.reshape(-1, 5))
    table = read("\n".join([*head, *rows]).encode(), "record.AT2")
    found = imported(table, guess(table).mapping)
    assert found.dt == pytest.approx(0.005)
    channel = found.channels[0]
    np.testing.assert_allclose(channel.values, 9.80665 * samples, atol=1e-9)  # six digits are written, none is lost


def test_every_channel_of_a_cosmos_file_is_a_column() -> None:
    def block(name: str, scale: float) -> list[str]:
        rows = ["".join(f"{scale * k:10.3f}" for k in range(first, first + 8)) for first in range(0, 80, 8)]
        opening = "   80 points of accel data equally spaced at  .020 sec.      (Units: cm/sec/sec)"
        return [
            "Corrected accelerogram",
            f"Chan  {name}: {name} Deg",
            opening,
            *rows,
            "/&  ----------  End of data for channel",
        ]

    table = read("\n".join([*block("1", 1.0), *block("2", 2.0)]).encode(), "two.v2")
    assert [len(column.values) for column in table.columns] == [80, 80]
    assert {column.dt for column in table.columns} == {0.02} and {column.unit for column in table.columns} == {"cm/s^2"}
    np.testing.assert_allclose(table.columns[1].values, 2 * table.columns[0].values)


def test_missing_values_come_as_nan_and_columns_of_text_are_left_out() -> None:
    table = read(b"time,operator,disp (mm),note\n0,Ana,1.5,\n0.1,Ana,,ok\n0.2,Ana,NaN,ok\n0.3,Ana,2.5,ok\n", "a.csv")
    assert list(table.names) == ["time", "disp (mm)"]
    assert np.isnan(table.names["disp (mm)"].values).tolist() == [False, True, True, False]
    assert table.notes == ("operator holds text", "note holds text")
    assert np.isnan(read(json.dumps({"x": [1, None, 3], "y": [1, 2, 3]}).encode(), "a.json").names["x"].values[1])


def test_parquet_tells_what_is_missing() -> None:
    columns = COLUMNS.copy()
    columns[7, 1] = np.nan
    table = read(made.parquet(columns), "test.parquet")
    assert np.flatnonzero(np.isnan(table.names["Disp (mm)"].values)).tolist() == [7]
    assert table.notes == ("column operator contains no numbers",)


@pytest.mark.parametrize(
    ("raw", "filename", "told"),
    [
        (b"", "a.csv", "is empty"),
        (b"operator,note\nAna,fine\nBo,good\n", "a.csv", "is not a row of numbers"),
        (b"t,x\n0,1\n1,2,3\n2,4\n3,5\n", "a.csv", "line 3 = 1,2,3: has 3 fields; the others have 2"),
        (b"t,x\n0,1\n1,2\n2,4\n3,oops\n4,1\n5,1\n6,1\n7,1\n", "a.csv", "line 5 = oops: column 2 is not a number"),
        (b"0,1\n0,2\n0,3\n", "a.csv", "the comma can be a decimal sign or a separator"),
        (b'{"x": [1, 2', "a.json", "is not valid JSON"),
        (b'{"x": "nothing"}', "a.json", "contains no column of numbers"),
        (b"[" * 100_000, "a.json", "nested too deeply"),
        (b"MATLAB 5.0 MAT-file".ljust(200, b"x"), "a.mat", "a variable states 2021161080 bytes; the file has 64"),
        (b"\x89HDF\r\n\x1a\n" + b"x" * 100, "a.h5", "cannot be read as HDF5"),
        (b"PAR1" + b"x" * 50 + b"PAR1", "a.parquet", "cannot be read as Parquet"),
        (b"\x00\x01\x02\x03" * 9, "a.bin", "is binary, not text"),
    ],
)
def test_what_cant_be_read_is_refused_with_the_reason(raw: bytes, filename: str, told: str) -> None:
    with pytest.raises(MeasuredError) as refusal:
        read(raw, filename)
    assert told in str(refusal.value)


@pytest.fixture(scope="module")
def impatient() -> Iterator[None]:
    """A damaged HDF5 file can hold its library for ever: about one in a thousand of those below."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(apart, "PATIENCE_S", 8.0)
        yield


@pytest.mark.usefixtures("impatient")
@given(
    st.sampled_from([made.matlab5(), made.matlab73(), made.hdf5(), made.parquet(), made.json_nested(), csv()]),
    st.lists(st.tuples(st.integers(0, 10**9), st.integers(0, 255)), min_size=1, max_size=20),
    st.integers(0, 10**9),
)
def test_a_damaged_file_is_read_or_refused_but_never_an_error_of_the_program(
    raw: bytes, changes: list[tuple[int, int]], cut: int
) -> None:
    damaged = bytearray(raw[: 1 + cut % len(raw)] if cut % 2 else raw)
    for at, value in changes:
        damaged[at % len(damaged)] = value
    try:
        table = read(bytes(damaged), "damaged.bin")
        examine(table, guess(table).mapping)
    except MeasuredError as refusal:
        assert refusal.issues


def test_a_file_over_which_reading_does_not_end_is_refused_and_the_next_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    apart.stop()  # so that there is something to wait for
    with monkeypatch.context() as patch:
        patch.setattr(apart, "PATIENCE_S", 1e-6)
        with pytest.raises(MeasuredError, match="crashes or does not end"):
            read(made.hdf5(), "held.h5")
    assert read(made.hdf5(), "next.h5").format == "HDF5"


def test_a_reading_process_that_has_died_is_replaced() -> None:
    read(made.parquet(), "first.parquet")
    process = apart._READER._process
    assert process is not None
    process.kill()
    assert read(made.parquet(), "next.parquet").format == "Parquet"


def test_an_hdf5_file_can_name_no_other_file_of_the_machine(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "secret.h5", "w") as secret:
        secret.create_dataset("x", data=np.arange(9.0))
    np.arange(9.0).tofile(tmp_path / "secret.bin")
    file = io.BytesIO()
    with h5py.File(file, "w") as written:
        written.create_dataset("own", data=np.arange(5.0))
        written["link"] = h5py.ExternalLink(str(tmp_path / "secret.h5"), "/x")
        written.create_dataset("stored", (9,), "f8", external=[(str(tmp_path / "secret.bin"), 0, 72)])
        layout = h5py.VirtualLayout((9,), "f8")
        layout[:] = h5py.VirtualSource(tmp_path / "secret.h5", "x", (9,))
        written.create_virtual_dataset("virtual", layout)
    assert list(read(file.getvalue(), "a.h5").names) == ["own"]


def test_a_small_file_that_claims_to_be_huge_is_refused_unread() -> None:
    file = io.BytesIO()
    with h5py.File(file, "w") as written:
        written.create_dataset("x", (MOST_SAMPLES + 1,), "f8", chunks=(1024,))
    with pytest.raises(MeasuredError, match="expands to more than 32 MB"):
        read(file.getvalue(), "a.h5")


@pytest.mark.parametrize("line", ["# paused", "4,5 # late", "4,5,6", "4,1.501.51", "4,****"])
def test_a_line_between_rows_that_is_not_a_row_is_refused_by_its_number(line: str) -> None:
    rows = "".join(f"{k / 100},{k % 7}\n" for k in range(200))
    with pytest.raises(MeasuredError, match=r"^line 202\b"):
        read(f"time (s),x (mm)\n{rows}{line}\n{rows}".encode(), "paused.csv")


def test_the_head_of_a_file_decides_its_columns_however_long_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(columns, "LOOKED_INTO", 4000)
    rows = "".join(f"{k},25;{k % 7},5;\r\n" for k in range(2000))
    (tmp_path / "long.csv").write_text(f"rig µ\r\nTime;Displacement;\r\n[s];[mm];\r\n{rows}n/a;-;\r\n")
    table = read(tmp_path / "long.csv", "long.csv")
    assert [(one.name, one.unit) for one in table.columns] == [("Time", "s"), ("Displacement", "mm")]
    assert np.array_equal(table.columns[1].values[:-1], np.arange(2000) % 7 + 0.5)
    assert all(np.isnan(one.values[-1]) for one in table.columns)
