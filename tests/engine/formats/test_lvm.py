"""LabVIEW measurement files: channels with unit, step and start; every number of the header is compared with the data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers.lvm import Signal, written

FORCE = Signal("Force", [8368.6722, 8431.4601, -0.00002, 8556.0], "Newtons")
DISP = Signal("Disp", [0.0, 0.2513, 0.5025, -12.5], "mm")


def read(content: bytes) -> Table:
    return registry.read(Source("test.lvm", content=content))


def refusal(content: bytes) -> str:
    with pytest.raises(FileError) as refused:
        read(content)
    return str(refused.value)


@pytest.mark.parametrize("x_columns", ["No", "One", "Multi"])
@pytest.mark.parametrize(("separator", "decimal"), [("\t", "."), ("\t", ","), (",", "."), (";", ",")])
def test_channels_come_back_with_unit_step_and_start(x_columns: str, separator: str, decimal: str) -> None:
    table = read(written([[FORCE, DISP]], x_columns=x_columns, separator=separator, decimal=decimal))
    assert table.format == "LabVIEW measurement file"
    assert [(one.name, one.unit, one.dt, one.start) for one in table.columns] == [
        ("Force", "Newtons", 0.004, 0.0),
        ("Disp", "mm", 0.004, 0.0),
    ]
    for one, signal in zip(table.columns, (FORCE, DISP), strict=True):
        assert one.values.tolist() == list(signal.values)
    assert table.about["operator"] == "Ana" and "Y_Unit_Label" in table.header


def test_a_short_header_without_the_one_of_the_file_is_read() -> None:
    head = (
        "Y_Unit_Label\tNewtons\tmm\t\nDelta_X\t0.004000\t0.004000\t\n***End_of_Header***\t\t\t\nX_Value\tForce\tDisp\tComment\n"
    )
    table = read((head + "\t8.5\t0.25\n\t8.25\t0.5\n").encode())
    assert [(one.name, one.unit, one.dt, one.values.tolist()) for one in table.columns] == [
        ("Force", "Newtons", 0.004, [8.5, 8.25]),
        ("Disp", "mm", 0.004, [0.25, 0.5]),
    ]


def test_a_file_without_headers_of_segments_or_without_its_first_line_is_read() -> None:
    rows = "0.000000\t1.5\n0.004000\t2.5\n0.008000\t3.5\n"
    table = read(f"LabVIEW Measurement\nX_Columns\tOne\n***End_of_Header***\nX_Value\tForce (kN)\tComment\n{rows}".encode())
    assert [(one.name, one.dt, one.values.tolist()) for one in table.columns] == [("Force (kN)", 0.004, [1.5, 2.5, 3.5])]
    head = "Separator\tSemicolon\nDecimal_Separator\t,\nDelta_X;0,004\n***End_of_Header***\nX_Value;Force;Comment\n"
    table = read((head + ";1,5\n;2,5\n").encode())
    assert [(one.name, one.dt, one.values.tolist()) for one in table.columns] == [("Force", 0.004, [1.5, 2.5])]


def test_a_name_that_states_another_unit_than_its_label_is_refused() -> None:
    content = written([[Signal("Force (kN)", [1.0, 2.0], "Newtons")]])
    assert "line 18: Y_Unit_Label states 'Newtons' for the channel 'Force (kN)'" in refusal(content)
    assert read(written([[Signal("Force (kN)", [1.0, 2.0], "kN")]])).columns[0].unit == "kN"


def test_channels_of_their_own_rate_and_start() -> None:
    fast = Signal("a", [1.0, 2.0, 3.0, 4.0], dt=0.001, time="10:00:00.500000")
    slow = Signal("b", [5.0, 6.0], dt=0.002, x0=0.25, time="10:00:00.502000")
    for x_columns in ("No", "One", "Multi"):
        table = read(written([[fast, slow]], x_columns=x_columns))
        assert [one.dt for one in table.columns] == [0.001, 0.002]
        assert [one.start for one in table.columns] == pytest.approx([0.0, 0.252], abs=1e-6)
        assert [len(one.values) for one in table.columns] == [4, 2]


@pytest.mark.parametrize("x_columns", ["No", "One", "Multi"])
@pytest.mark.parametrize(
    ("unit", "seconds"), [("ms", 1e-3), ("us", 1e-6), ("s", 1.0), ("min", 60.0), ("msec", 1e-3), ("", 1.0)]
)
def test_step_and_start_are_in_the_unit_of_x(x_columns: str, unit: str, seconds: float) -> None:
    values = np.arange(40.0).tolist()
    signals = [Signal(name, values, dt=4, x0=8, x_unit=unit) for name in ("F", "d")]
    found = read(written([signals], x_columns=x_columns))
    assert [one.dt for one in found.columns] == pytest.approx([4 * seconds] * 2)
    assert [one.start for one in found.columns] == pytest.approx([8 * seconds] * 2)


def test_a_channel_over_another_unit_has_no_step() -> None:
    found = read(written([[Signal("F", np.arange(40.0).tolist(), dt=4, x_unit="Hz")]]))
    assert found.columns[0].dt is None and "F is over Time in Hz, not over time" in found.notes


@pytest.mark.parametrize("pref", ["Absolute", "Relative"])
@pytest.mark.parametrize("x_columns", ["No", "One", "Multi"])
def test_a_channel_starts_at_its_own_date_and_time(pref: str, x_columns: str) -> None:
    values = np.arange(40.0).tolist()
    signals = [Signal("F", values), Signal("d", values, time="10:00:01.000000", x0=0.5)]
    found = read(written([signals], x_columns=x_columns, pref=pref))
    assert [one.start for one in found.columns if one.quantity != "time"] == pytest.approx([0.0, 1.5])


def test_segments_whose_headers_state_that_time_goes_on_are_joined() -> None:
    second = Signal("Force", [1.0, 2.0], x0=0.016, time="10:00:00.016000", unit="Newtons")
    table = read(written([[FORCE], [second]]))
    assert [one.values.tolist() for one in table.columns] == [[*FORCE.values, 1.0, 2.0]]
    assert table.notes == ("2 segments are joined: their headers state that time goes on",)


@pytest.mark.parametrize("x0", [0.0, 5.0])
def test_segments_with_a_pause_between_them_are_columns_of_their_own(x0: float) -> None:
    second = Signal("Force", [1.0, 2.0], x0=x0, time="10:00:05.000000", unit="Newtons")
    table = read(written([[FORCE], [second]]))
    assert [(one.name, one.start) for one in table.columns] == [("Force (segment 1)", 0.0), ("Force (segment 2)", 5.0)]
    assert "do not state that time goes on" in table.notes[0]


def test_segments_of_one_sample_are_rows_at_the_times_of_their_headers() -> None:
    times = (0.0, 6.341, 6.389)
    segments = [[Signal("T", [float(k)], x0=x0, time=f"10:00:{x0:09.6f}")] for k, x0 in enumerate(times)]
    table = read(written(segments, x_columns="One"))
    assert [(one.name, one.unit, one.values.tolist()) for one in table.columns] == [
        ("X_Value", "s", list(times)),
        ("T", "N", [0.0, 1.0, 2.0]),
    ]


def test_segments_with_other_channels_stay_apart() -> None:
    table = read(written([[FORCE], [DISP]]))
    assert [one.name for one in table.columns] == ["Force (segment 1)", "Disp (segment 2)"]


def test_packets_under_one_header_have_no_step_unless_their_times_are_given() -> None:
    content = written([[FORCE]], headings="No").replace(b"Samples\t4", b"Samples\t2")
    table = read(content)
    assert table.columns[0].dt is None and "whether time goes on between them is not stated" in table.notes[0]
    timed = read(written([[FORCE]], headings="No", x_columns="One").replace(b"Samples\t4", b"Samples\t2"))
    assert timed.columns[0].dt == 0.004 and timed.notes == (
        "2 packets of 2 samples under one header: their times are in X_Value",
    )


def test_a_special_block_and_comments_are_named() -> None:
    table = read(written([[FORCE, DISP]], special=True, comment="valve 0.5 open"))
    assert table.notes == ("line 14: a special block is not read", "line 30 has the comment 'valve 0.5 open'")
    assert table.columns[1].values.tolist() == DISP.values


def test_a_rounded_step_is_named_where_it_moves_the_end_by_half_a_sample() -> None:
    signal = Signal("a", [0.0] * 8192, dt=1 / 1024)
    table = read(written([[signal]]))
    assert table.columns[0].dt == 0.000977
    assert "Delta_X = 0.000977 is rounded, so that time is uncertain by 0.0041 s at the end" in table.notes[0]
    assert "the only whole rate that is written so is 1024 Hz" in table.notes[0]
    assert read(written([[signal]], x_columns="One")).columns[0].dt == pytest.approx(1 / 1024, rel=1e-7)


CONTRADICTIONS = [
    ("Samples\t4\t4", "Samples\t5\t4", "line 15: states a number of samples of Force of 5; the data have 4"),
    ("Channels\t2", "Channels\t3", "line 14: states a number of channels of 3; the data have 2"),
    ("Delta_X\t0.004000\t0.004000", "Delta_X\t0.005000\t0.005000", "states a time step of 0.005 s; the data have 0.004 s"),
    ("X0\t0.0000000000000000E+00", "X0\t5.0000000000000000E-01", "states a time of the first sample of Force of 0.5 s"),
    ("\t8431.460100", "\t8431,460100", "line 25 = 8431,460100: column Force is not a number"),
    ("\t8431.460100", "\t", "line 25: column Force is empty between its values"),
    ("\t8431.460100", "\t********", "line 25 = ********: column Force is not a number"),
    ("\t8431.460100", "\t1.501.51", "line 25 = 1.501.51: column Force is not a number"),
    ("0.004000\t8431", "0.014000\t8431", "X_Value goes from 0.014 to 0.008: a new part starts here, whose time is not stated"),
    ("\r\n0.008000\t", "\r\n9.008000\t", "X_Value goes from 9.008 to 0.012"),
    ("Channels\t2", "Channels\ttwo", "line 14 = two: Channels is not a number"),
    ("Separator\tTab", "Separator\tBar", "Separator = Bar: is not a known separator"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "told"), CONTRADICTIONS)
def test_what_contradicts_its_header_is_refused(old: str, new: str, told: str) -> None:
    content = written([[FORCE, DISP]], x_columns="One").decode()
    assert old in content
    assert told in refusal(content.replace(old, new, 1).encode())


def test_a_decimal_comma_between_commas_is_refused() -> None:
    content = written([[FORCE, DISP]], x_columns="One", separator=",").replace(b"8431.460100", b"8431,460100")
    assert "line 25: has a number in the column of comments" in refusal(content)


def test_a_segment_whose_date_contradicts_its_x0_is_refused() -> None:
    second = Signal("Force", [1.0, 2.0], x0=0.016, time="10:00:07.000000", unit="Newtons")
    told = "start of segment 2 of Force after segment 1 by date and time of 7 s; the data have 0.016 s"
    assert told in refusal(written([[FORCE], [second]]))


def test_rows_after_an_empty_line_without_a_header_are_not_appended() -> None:
    head = "Delta_X\t0.004000\t\n***End_of_Header***\t\t\nX_Value\tForce\tComment\n"
    assert "line 7: starts new rows without a header" in refusal((head + "\t8.5\n\t8.25\n\n\t1.0\n\t2.0\n").encode())


name = st.text("abcXYZ_ 0123456789()", min_size=1, max_size=10).map(str.strip).filter(lambda one: one not in {"", "Comment"})
sample = st.floats(-1e5, 1e5).map(lambda one: float(f"{one:.6f}"))


@given(
    st.lists(name, min_size=1, max_size=4, unique=True),
    st.integers(2, 12),
    st.sampled_from(["No", "One", "Multi"]),
    st.sampled_from([("\t", "."), ("\t", ","), (",", "."), (";", ",")]),
    st.sampled_from([1e-5, 0.004, 0.25, 2.0]),
    st.data(),
)
def test_any_file_comes_back(
    names: list[str], count: int, x_columns: str, signs: tuple[str, str], dt: float, data: st.DataObject
) -> None:
    signals = [Signal(one, data.draw(st.lists(sample, min_size=count, max_size=count)), "kN", dt) for one in names]
    separator, decimal = signs
    table = read(written([signals], x_columns=x_columns, separator=separator, decimal=decimal))
    assert [(one.name, one.unit) for one in table.columns] == [(one.name, one.unit) for one in signals]
    for one, signal in zip(table.columns, signals, strict=True):
        np.testing.assert_allclose(one.values, signal.values, atol=1e-6, rtol=0)
        assert one.dt == pytest.approx(dt, rel=1e-9)


@given(st.integers(1, 1200), st.lists(st.tuples(st.integers(0, 10**6), st.integers(9, 126)), max_size=5))
def test_a_damaged_or_cut_file_is_read_or_refused(cut: int, changes: list[tuple[int, int]]) -> None:
    damaged = bytearray(written([[FORCE, DISP], [FORCE, DISP]], x_columns="One", comment="x")[:cut])
    for at, byte in changes:
        damaged[at % len(damaged)] = byte
    try:
        registry.read(Source("a.lvm", content=bytes(damaged)), format="lvm")
    except FileError as refused:
        assert refused.issues
