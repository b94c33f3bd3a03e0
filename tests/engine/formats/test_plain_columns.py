"""Tables of measurements in text of no known format: what was written comes back, no row or statement is passed over."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers import plain as made

T = np.arange(400) / 250
F = 11.4 * np.cos(7 * T)
D = 12.5 * np.sin(7 * T)
HEAD = "Time (s),Force (kN),Disp (mm)"
ROWS = made.table([T, F, D])
DECIMALS = 0.5001e-4
NUMBERS = st.floats(-98, 98).map(lambda value: round(value, 4))


def read(text: str | bytes) -> Table:
    return registry.read(Source("test.csv", content=text if isinstance(text, bytes) else text.encode()), format="columns")


def refused(text: str | bytes, *words: str) -> None:
    with pytest.raises(FileError) as caught:
        read(text)
    for word in words:
        assert word in str(caught.value), str(caught.value)


def same(table: Table, *expected: np.ndarray, within: float = DECIMALS) -> None:
    assert len(table.columns) == len(expected), [one.name for one in table.columns]
    for column, one in zip(table.columns, expected, strict=True):
        np.testing.assert_allclose(column.values, one, atol=within)


def units(table: Table) -> list[tuple[str, str]]:
    return [(one.name, one.unit) for one in table.columns]


@given(
    st.integers(1, 6).flatmap(
        lambda width: st.lists(
            st.lists(st.floats(-98, 98).map(lambda value: round(value, 4)), min_size=width, max_size=width),
            min_size=3,
            max_size=30,
        )
    ),
    st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."), ("   ", "."), ("  ", ",")]),
    st.sampled_from(["fixed", "E", "D"]),
    st.booleans(),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
    st.sampled_from(["none", "names", "names and units", "units and names", "comment"]),
)
def test_any_table_comes_back_with_its_names_and_units(
    rows: list[list[float]], form: tuple[str, str], style: str, quoted: bool, end: str, encoding: str, heading: str
) -> None:
    separator, decimal = form
    quoted = quoted and separator.strip(" ") != ""
    width = len(rows[0])
    names, kinds = [f"sensor{chr(65 + k)}" for k in range(width)], ["mm", "kN", "s", "µε", "m/s²", "V"][:width]
    above = {
        "none": [],
        "names": [names],
        "names and units": [names, kinds],
        "units and names": [kinds, names],
        "comment": [names],
    }
    mark = "# " if heading == "comment" else ""
    if width == 1:
        heading, above = "none", {"none": []}  # a line above one column is text about it
    header = [mark + separator.join(one) for one in above[heading]]
    text = made.table(list(zip(*rows, strict=True)), header, separator, decimal, style, quoted, 9).replace("\n", end)
    if width == 1 and decimal == ",":
        return  # whether the comma is a decimal sign cannot be told
    table = read(text.encode(encoding))
    same(table, *np.array(rows).T, within=1e-5)
    if above[heading]:
        assert [one.name for one in table.columns] == names
        assert [one.unit for one in table.columns] == (kinds if "units" in heading else [""] * width)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (["Time,Load cell,LVDT", "s,kgf,µstr"], [("Time", "s"), ("Load cell", "kgf"), ("LVDT", "µstr")]),
        (["[s],[kN],[mm]", "Time,Load,LVDT"], [("Time", "s"), ("Load", "kN"), ("LVDT", "mm")]),
        (["Zeit/s,Kraft/kN,Weg/mm"], [("Zeit/s", "s"), ("Kraft/kN", "kN"), ("Weg/mm", "mm")]),
        (["Time,Actuator 1,", ",Force,Disp"], [("Time", ""), ("Actuator 1 Force", ""), ("Disp", "")]),
        (['"Time","Load cell, main","LVDT"', '"s","kN","mm"'], [("Time", "s"), ("Load cell, main", "kN"), ("LVDT", "mm")]),
        (["Operator,Ana", "t,F,x"], [("t", ""), ("F", ""), ("x", "")]),
        (["rig 3", "Time (s),Force (kgf),Disp (mm),"], [("Time (s)", "s"), ("Force (kgf)", "kgf"), ("Disp (mm)", "mm")]),
        (["Time (s),Force (kN),Disp (mm),Comment"], [("Time (s)", "s"), ("Force (kN)", "kN"), ("Disp (mm)", "mm")]),
        (["Time;Force;Disp"], [("Time", ""), ("Force", ""), ("Disp", "")]),
    ],
)
def test_names_and_units_are_read_from_every_kind_of_heading(lines: list[str], expected: list[tuple[str, str]]) -> None:
    table = read(made.text(lines) + ROWS)
    same(table, T, F, D)
    assert units(table) == expected and table.header == "\n".join(lines)


def test_names_that_are_not_as_many_as_the_columns_are_not_used() -> None:
    table = read('"Time","Force","Disp"\n' + made.text([f'"{k}",{row}' for k, row in enumerate(ROWS.splitlines())]))
    assert not table.named and "has 3 fields, the rows of numbers have 4" in table.notes[0]


def test_an_empty_last_column_keeps_the_names_and_a_column_of_text_is_noted() -> None:
    empty = read(f"{HEAD},Temperature (C)\n" + ROWS.replace("\n", ",\n"))
    assert units(empty)[:3] == units(read(f"{HEAD}\n{ROWS}")) and np.isnan(empty.columns[3].values).all()
    same(read(f"{HEAD}\n" + ROWS.replace("\n", ",\n")), T, F, D)
    table = read(f"operator,{HEAD}\n" + made.text([f"Ana,{row}" for row in ROWS.splitlines()]))
    same(table, T, F, D)
    assert table.notes == ("operator holds text",)


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        ("0.04,-9999,0.1", "is -9999"),
        ("0.04,999.99,0.1", "is 999.99"),
        ("0.04,1e30,0.1", "is 1e+30"),
        ("0.04,Inf,0.1", "column 2 is infinite"),
        ("0.04,1e999,0.1", "column 2 is infinite"),
        ("0.04,*****,0.1", "too long for its field"),
        ("0.04,####,0.1", "too long for its field"),
        ("0.04,1.501.51,0.1", "numbers touch"),
        ("0.04,oops,0.1", "column 2 is not a number"),
        ("0.04,0.1", "has 2 fields; the others have 3"),
        ("0.04,1,2,3", "has 4 fields; the others have 3"),
        ("0,04,1,2,0,1", "has 6 fields; the others have 3"),
        ("# pause", "comment among the numbers"),
        (HEAD, "repeats the header"),
        ("logger stopped", "is not a number"),
        ("\n0.04,1,2", "follows a blank line"),
    ],
)
def test_what_is_no_row_of_the_table_is_refused_with_its_line(bad: str, words: str) -> None:
    rows = ROWS.splitlines()
    line = 103 if bad.startswith("\n") else 102
    refused(made.text([HEAD, *rows[:100], bad, *rows[100:]]), f"line {line}", words)


@pytest.mark.parametrize("footer", ["End of file", "Checksum,AF12,", "# 400 rows", "Ende der Messung"])
def test_a_footer_is_refused_and_to_be_removed(footer: str) -> None:
    refused(f"{HEAD}\n{ROWS}\n{footer}\n", "line 403", "remove it")


def test_missing_values_are_nan_and_blank_lines_after_every_row_are_layout() -> None:
    rows = ROWS.splitlines()
    rows[7:10] = ["0.028,#N/A,1", "0.032,,NaN", "0.036,-,n/a"]
    table = read(made.text([HEAD, *rows]))
    assert np.flatnonzero(np.isnan(table.columns[1].values)).tolist() == [7, 8, 9]
    same(read(HEAD + "\n" + ROWS.replace("\n", "\n\n")), T, F, D)


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        ("Messrate: 100 Hz", ("time step of 0.01 s", "0.004 s")),
        ("Sampling interval: 5 ms", ("time step of 0.005 s", "0.004 s")),
        ("Fréquence d'échantillonnage : 1 kHz", ("0.001 s", "0.004 s")),
        ("Number of samples: 500", ("number of samples of 500", "400")),
        ("Anzahl Messwerte: 4.000", ("4000", "400")),
        ("Número de muestras: 40", ("40", "400")),
        ("Duration: 3.2 s", ("duration of 3.2 s", "1.6 s")),
        ("Number of channels: 5", ("number of channels of 5", "the data have 3")),
        ("Peak force: 12.4 kN", ("peak of Force (kN) of 12.4 kN", "11.4 kN")),
        ("401", ("401", "400 samples")),
    ],
)
def test_each_contradiction_of_the_header_names_both_numbers(statement: str, words: tuple[str, ...]) -> None:
    refused(f"{statement}\n{HEAD}\n{ROWS}", "line 1", *words)


@pytest.mark.parametrize(
    "statement",
    [
        "Messrate: 250,0 Hz", "Sampling interval: 4 ms", "samples: 400", "400", "Messdauer: 1,6 s", "Number of channels: 2",
        "Peak force: 11.4 kN", "Peak force: 11400 N", "Force capacity: max. 100 kN", "Loading rate: 0.5 mm/s", 
        "Frequency: 1 Hz", "Specimen: 3", "Step 3", "Stroke max: 150 mm", "Version 2.1, 2024-01-31 12:00:00", "Period: 0.5 s",
        "low-pass filter 100 Hz",
    ],
)  # fmt: skip
def test_what_agrees_or_states_something_else_does_not_refuse_the_table(statement: str) -> None:
    same(read(f"{statement}\n{HEAD}\n{ROWS}"), T, F, D)


def test_a_sample_number_is_not_time_and_takes_the_step_of_the_header() -> None:
    rows = made.table([np.arange(1, 401), F], ["Sample,Force (kN)"], digits=3)
    sample, force = read(f"# Sampling rate: 250 Hz\n{rows}").columns
    assert (sample.quantity, sample.unit, force.dt) == ("", "", 0.004)
    assert read(rows).columns[1].dt is None
    unclear = read(f"dt = 4\n{rows}")
    assert unclear.columns[1].dt is None and "without a unit" in unclear.notes[0]
    gap = [row for row in rows.splitlines() if not row.startswith(("50.", "51."))]
    refused(made.text(gap), "line 51", "samples are missing")


def test_a_time_without_a_unit_keeps_none_and_a_stated_step_must_fit_one() -> None:
    rows = made.table([1000 * T, F], ["Time,Force (kN)"])
    assert (read(rows).columns[0].unit, read(rows).columns[1].dt) == ("", None)
    assert read(f"Sampling rate: 250 Hz\n{rows}").columns[1].dt == 0.004
    refused(f"Sampling rate: 100 Hz\n{rows}", "time step of 0.01 s", "in no unit of time")


@pytest.mark.parametrize(
    "stamp",
    [
        lambda t: f"2024-02-03T12:34:{50 + t:09.6f}",
        lambda t: f"2024-02-03 12:34:{50 + t:06.3f}",
        lambda t: f"03.02.2024 12:34:{50 + t:06.3f}",
        lambda t: f"02/03/2024 04:05:{6 + t:06.3f} PM",
        lambda t: f"3-Feb-2024 12:34:{50 + t:06.3f}",
        lambda t: f"12:34:{50 + t:06.3f}",
        lambda t: f"34:{50 + t:06.3f}",
        lambda t: f"{'31/01/2024 23:59:' if t < 1 else '01/02/2024 00:00:'}{(59 + t) % 60:06.3f}",
        lambda t: f"{'23:59:' if t < 1 else '00:00:'}{(59 + t) % 60:06.3f}",
        lambda t: f"{45000.5 + t / 86400:.11f}",
    ],
)
def test_dates_and_clocks_become_seconds_from_the_first(stamp) -> None:  # type: ignore[no-untyped-def]
    rows = made.text(["Date,Force (kN)", *(f"{stamp(t)},{f:.4f}" for t, f in zip(T, F, strict=True))])
    table = read(rows)
    same(table, T, F, within=1e-4)
    assert (table.columns[0].unit, table.columns[0].quantity) == ("s", "time")
    same(read(f"Sampling rate: 250 Hz\n{rows}"), T, F, within=1e-4)
    refused(f"Sampling rate: 200 Hz\n{rows}", "0.005 s", "0.004")


def test_a_date_and_a_clock_in_two_columns_are_one_time_and_a_broken_stamp_is_refused() -> None:
    lines = [f"03.02.2024 12:34:{50 + t:06.3f} {f:.4f}" for t, f in zip(T, F, strict=True)]
    same(read(made.text(["Date Time Force(kN)", *lines])), T, F)
    lines[50] = lines[50].replace("12:34", "12.34")
    refused(made.text(["Date Time Force(kN)", *lines]), "line 52", "not a date and a time")
    lines = ["01/02/2024 12:00:00,1", "02/03/2024 12:00:01,2", "03/05/2024 12:00:02,3"]
    refused(made.text(["Date,Force", *lines]), "order of day and month")


@pytest.mark.parametrize(
    ("separator", "decimal", "thousands", "quoted"),
    [(",", ".", ",", True), (";", ".", ",", False), (";", ",", ".", False), (";", ".", "'", False), ("\t", ",", " ", False)],
)
def test_signs_between_thousands_are_read_where_they_are_certain(
    separator: str, decimal: str, thousands: str, quoted: bool
) -> None:
    def written(value: float) -> str:
        text = f"{value:,.1f}".replace(",", "T").replace(".", decimal).replace("T", thousands)
        return f'"{text}"' if quoted else text

    rows = [f"{t:.3f}".replace(".", decimal) + separator + written(1000 * f) for t, f in zip(T, F, strict=True)]
    same(read(made.text([f"Time (s){separator}Force (N)", *rows])), T, 1000 * F, within=0.0501)


def test_a_comma_that_can_mean_two_things_and_mixed_decimal_signs_are_refused() -> None:
    refused(made.text([f"{k};1,{k + 200}" for k in range(100)]), "line 1", "separate thousands")
    rows = [f"{t:.3f};{f:.3f};" + f"{d:.3f}".replace(".", ",") for t, f, d in zip(T, F, D, strict=True)]
    refused(made.text(["t;F;x", *rows]), "decimal sign")
    rows = ROWS.replace(",", ";").splitlines()
    rows[390] = rows[390].replace(".", ",")
    refused(made.text(["t;F;x", *rows]), "line 392")


def test_numbers_that_touch_are_read_at_signs_alone() -> None:
    signed = [f"{t:8.3f}{-f - 500:9.4f}{d - 500:9.4f}" for t, f, d in zip(T, F, D, strict=True)]
    same(read(made.text(["Time Force Disp", *signed])), T, -F - 500, D - 500, within=0.501e-3)
    glued = [f"{t:8.3f}{f + 1500:9.4f}{d + 1500:9.4f}" for t, f, d in zip(T, F, D, strict=True)]
    refused(made.text(["Time Force Disp", *glued]), "is not a row of numbers")


def test_rows_of_signals_are_read_as_signals() -> None:
    lines = [",".join([name, *(f"{value:.4f}" for value in row)]) for name, row in (("Time (s)", T), ("Force (kN)", F))]
    table = read(made.text(lines))
    same(table, T, F)
    assert units(table) == [("Time (s)", "s"), ("Force (kN)", "kN")]
    same(read(made.text([line.partition(",")[2].replace(",", " ") for line in lines])), T, F)
    refused(made.text([lines[0], lines[1] + ",5"]), "line 2", "has 401 numbers; the others have 400")


def test_a_count_above_the_rows_is_compared_and_never_a_sample() -> None:
    same(read("400\n" + made.table([F])), F)
    refused("401\n" + made.table([F]), "line 1", "400 samples")
    same(read("400,,\n" + ROWS), T, F, D)  # as a spreadsheet fills the row up
    refused("401,,\n" + ROWS, "line 1", "400 samples")


def test_numbers_of_columns_above_the_data_are_refused() -> None:
    refused(f"{HEAD}\n1,2,3\n{ROWS}", "line 2", "can number the columns or be a sample")


def test_tabs_and_blanks_between_numbers_can_mix() -> None:
    rows = [f"{t:.4f} \t{f:.4f}   {d:.4f}" for t, f, d in zip(T, F, D, strict=True)]
    same(read(made.text(["Time (s)\tForce (kN)\tDisp (mm)", *rows])), T, F, D)


@pytest.mark.parametrize("separator", [";", "\t", ","])
def test_a_point_that_can_separate_thousands_is_refused(separator: str) -> None:
    newtons = np.rint(1e4 * (1 + np.cos(7 * T)))
    rows = [f"{k}{separator}{int(n):,}".replace(",", ".") if separator != "," else f"{k},{int(n) // 1000}.{int(n) % 1000:03d}"
            for k, n in enumerate(newtons) if n >= 1000] + [f"400{separator}955"]  # fmt: skip
    refused("\n".join([f"Index{separator}Kraft (N)", *rows]) + "\n", "can be a decimal sign or separate thousands", "955")


def test_points_before_three_digits_are_decimal_where_they_are_in_every_number() -> None:
    text = "\n".join(["Force (kN);Cycle", *(f"{18 + k / 1000:.3f};{k}" for k in range(200))])
    same(read(text), 18 + np.arange(200) / 1000, np.arange(200.0))
    text = "\n".join(["Force (kN);Cycle", *(f"{18 + k / 1000:g};{k}" for k in range(200))])  # 18.719, 18.72, 19
    same(read(text), 18 + np.arange(200) / 1000, np.arange(200.0))
    steps = [0, 2.493, 2.493, 5, 5, 2.493, 2.498] * 20
    text = "\n".join(["Input (V);Cycle", *(f"{one:g};{k}" for k, one in enumerate(steps))])
    same(read(text), np.array(steps), np.arange(140.0))
    text = "\n".join(["Force (kN);Cycle", *(f"{k / 1000:.3f};{k}" for k in range(2000))])
    same(read(text), np.arange(2000) / 1000, np.arange(2000.0))


def test_remarks_below_the_units_are_no_names() -> None:
    table = read("Time,Force,Disp\ns,kN,mm\nmeasured,load cell 1,LVDT 3\n" + ROWS)
    assert units(table) == [("Time", "s"), ("Force", "kN"), ("Disp", "mm")]
    assert "below the units stands measured load cell 1 LVDT 3: not used" in table.notes


def test_a_heading_in_the_brackets_of_a_matrix_names_the_columns() -> None:
    table = read("[t; F; u]\n" + ROWS)
    assert [one.name for one in table.columns] == ["t", "F", "u"]


def test_a_date_above_the_names_is_no_part_of_them() -> None:
    table = read("Date,2020-01-01,\nTime (s),Force (kN),Disp (mm)\n" + ROWS)
    assert [one.name for one in table.columns] == ["Time (s)", "Force (kN)", "Disp (mm)"]


def test_a_point_is_decimal_where_another_column_shows_it() -> None:
    rows = "\n".join(f"{2.2 + 0.1 * k:.1f},{5 if k > 60 else '2.493'}" for k in range(90))
    table = read(f"Time (s),Input (V)\n{rows}\n")
    assert table.columns[1].values[0] == 2.493 and table.columns[1].values[-1] == 5
