"""One record in text of no known format: each arrangement of its numbers, each statement of its header held against them."""

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

T, A = made.burst()
B, C = 0.8 * A[::-1], 0.5 * np.roll(A, 7)
GAL = "units: cm/s^2, dt = 0.01 s"
TITLE = "# a made-up record"


def read(text: str | bytes) -> Table:
    return registry.read(Source("record.txt", content=text if isinstance(text, bytes) else text.encode()), format="record")


def refused(text: str | bytes, *words: str) -> None:
    with pytest.raises(FileError) as caught:
        read(text)
    for word in words:
        assert word in str(caught.value), str(caught.value)


def values(table: Table, *expected: np.ndarray, within: float = 0.5001e-4) -> None:
    assert len(table.columns) == len(expected), [one.name for one in table.columns]
    for column, one in zip(table.columns, expected, strict=True):
        np.testing.assert_allclose(column.values, one, atol=within)


@given(
    st.lists(st.floats(-98, 98).map(lambda value: round(value, 4)), min_size=9, max_size=80),
    st.integers(1, 10),
    st.sampled_from(["fixed", "E", "D"]),
    st.sampled_from([0, 14]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
    st.sampled_from(
        [
            "# dt = 0.005 s, units: gal, NPTS: {n}",
            "Anzahl der Messwerte: {n}\nAbtastrate: 200 Hz\nEinheit: gal",
            "Nombre de points : {n}\nPas de temps : 0,005 s\nUnité : gal",
            "Número de datos: {n}\nFrecuencia de muestreo: 200 Hz\nUnidad: gal",
            "Numero di campioni: {n}\nPasso di campionamento: 5 ms\nunità di misura: gal",
            "{n} data points equally spaced at .005 sec, in units of gal",
            "units: gal\n{n} 0.005",
        ]
    ),
)
def test_any_record_comes_back_with_its_step_and_unit(
    samples: list[float], per_line: int, style: str, width: int, end: str, encoding: str, header: str
) -> None:
    text = made.record(samples, header.format(n=len(samples)).split("\n"), per_line, style, width).replace("\n", end)
    (column,) = read(text.encode(encoding)).columns
    assert column.values.tolist() == pytest.approx(samples, abs=0.051 if style != "fixed" else 1e-9)
    assert column.dt == pytest.approx(0.005) and column.unit == "gal"


@pytest.mark.parametrize("names", ["N-S E-W U-D", "N-S;O-W;Vertikal", "NS (gal), EW (gal), UD (gal)", "# NS EW UD"])
def test_components_side_by_side_are_columns_with_their_names(names: str) -> None:
    separator = next((sign for sign in ";," if sign in names), " ")
    header = [
        "NUMBER OF DATA : 400",
        "SAMPLING INTERVAL (sec) : 0.01",
        "RAW PGA VALUES (gal): (N-S) 182.0 (E-W) 145.6 (U-D) 91.0",
    ]
    table = read(made.table([A, B, C], [*header, names], separator))
    values(table, A, B, C)
    assert {(one.unit, one.dt, one.quantity) for one in table.columns} == {("gal", 0.01, "acceleration")}


def test_the_peak_of_each_component_is_held_against_its_column() -> None:
    header = ["number of data: 400", "dt: 0.01 s", "PGA (gal): NS=182.0 EW=150.0 UD=91.0", "N-S E-W U-D"]
    refused(made.table([A, B, C], header, " "), "line 3", "peak of E-W of 150 gal", "145.6 gal")


def test_lines_of_three_numbers_are_columns_or_one_record_as_the_count_says_and_else_a_choice() -> None:
    rows = made.table([A, B, C], [], " ")
    values(read(f"samples: 400, {GAL}\n{rows}"), A, B, C)
    assert len(read(f"samples: 1200, {GAL}\n{rows}").columns[0].values) == 1200
    asked = read(f"{GAL}\n{rows}")
    assert [len(one.values) for one in asked.columns] == [1200, 400, 400, 400]
    assert "choose the channel" in asked.notes[0]
    refused(f"samples: 500, {GAL}\n{rows}", "500", "the data have 400")


@pytest.mark.parametrize(
    "line", ["400", "400 0.01", "400,0.01", "400, 0.01, cm/s^2", "  400   1.0E-02", "400\n\n", "400\n# acceleration follows"]
)
def test_a_count_above_the_samples_is_compared_and_never_a_sample(line: str) -> None:
    values(read(made.record(A, [GAL, line])), A)
    refused(made.record(A[:-1], [GAL, line]), "line 2", "399")


def test_a_second_count_among_the_samples_is_refused() -> None:
    refused(made.record(A[:200], [GAL]) + made.record(A[200:], ["200"]), "line 202", "count")


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        ("********", "too long for its field"),
        ("1.501.51", "numbers touch"),
        ("1.240-102", "numbers touch"),
        ("#N/A", "is not a number"),
        ("# gap of 3 s", "comment among the numbers"),
        ("a pause of the logger", "is not a number"),
        ("0.1 0.2", "has 2 numbers; the others have 1"),
        (GAL, "repeats the header"),
        ("-999", "usual mark"),
        ("-9999.0", "usual mark"),
        ("1.0e30", "usual mark"),
    ],
)
def test_what_is_no_sample_among_the_samples_is_refused_with_its_line(bad: str, words: str) -> None:
    lines = made.record(A / 20, [GAL]).splitlines()
    refused(made.text([*lines[:101], bad, *lines[101:]]), "line 102", words)


@pytest.mark.parametrize("footer", ["End of file", "Checksum: A45F", "# 400 samples", "*** end ***", "Fin du fichier"])
def test_a_footer_is_refused_and_to_be_removed(footer: str) -> None:
    refused(made.record(A, [GAL]) + f"\n{footer}\n\n", "line 403", footer, "remove it")


@pytest.mark.parametrize(
    "statement",
    ["missing: -99", "NoData value = -99", "Fehlwert: -99", "valeurs manquantes : -99", "-99 means no data", "sin dato: -99"],
)
def test_a_stated_mark_of_missing_values_is_refused_where_it_occurs(statement: str) -> None:
    values(read(made.record(A, [GAL, statement])), A)
    refused(made.record(np.where(T == 0.5, -99, A), [GAL, statement]), "line 53", "is -99", "line 2 states")


def test_blocks_with_a_header_each_are_signals_of_their_quantity_or_component() -> None:
    blocks = (
        made.record(A, [f"# acceleration, {GAL}"])
        + made.record(B, ["# velocity, cm/s"])
        + made.record(C, ["# displacement, cm"])
    )
    table = read(blocks)
    values(table, A, B, C)
    assert [one.quantity for one in table.columns] == ["acceleration", "velocity", "displacement"]
    assert [one.unit for one in table.columns] == ["cm/s^2", "cm/s", "cm"]
    sides = "".join(made.record(one, [f"Component: {name}"], 5) for one, name in ((A, "N-S"), (B, "E-W")))
    table = read(f"{GAL}\n{sides}")
    values(table, A, B)
    assert [one.name for one in table.columns] == ["N-S", "E-W"]


def test_blocks_that_a_blank_line_parts_are_a_choice_unless_the_count_joins_them() -> None:
    parts = made.record(A[:200], []) + "\n" + made.record(A[200:], [])
    values(read(f"{GAL}\n{parts}"), A[:200], A[200:])
    values(read(f"{GAL}, 400 samples\n{parts}"), A)
    refused(f"{GAL}\n{parts}\n\n1.0\n2.0\n", "line 405", "blank line")
    values(read(made.record(A, [GAL]).replace("\n", "\n\n")), A)


@pytest.mark.parametrize("per_line", [2, 5, 7])
def test_pairs_of_time_and_value_are_told_from_samples(per_line: int) -> None:
    fields = [f"{time:8.3f}{value:8.3f}" for time, value in zip(T, A - 90, strict=True)]  # signs touch
    lines = ["".join(fields[start : start + per_line]) for start in range(0, 400, per_line)]
    table = read(made.text(["time and acceleration in pairs, units: cm/s^2", *lines]))
    values(table, A - 90, within=0.5001e-3)
    assert table.columns[0].dt == 0.01 and "pairs" in " ".join(table.notes)


def test_a_fortran_format_in_the_header_separates_numbers_that_touch() -> None:
    size = np.abs(A) + 1
    values(read(made.record(size, [f"{GAL}, format (8F8.4)"], 8, width=8)), size)
    refused(made.record(size, [GAL], 8, width=8), "numbers touch")


@pytest.mark.parametrize(
    ("names", "columns", "scale"),
    [
        ("time(s)  disp(cm)  vel(cm/s)  acc(cm/s2)", (T, C, B, A), 1.0),
        ("acc(cm/s2)  time(s)", (A, T), 1.0),
        ("Zeit [s];Weg [cm];Beschleunigung [cm/s²]", (T, C, A), 1.0),
        ("Temps (ms);Accélération (cm/s²)", (1000 * T, A), 1.0),
        ("Time,Acceleration\ns,cm/s2", (T, A), 1.0),
        ("Sample,Time (s),acc (0.05 cm/s2)", (np.arange(400), T, 20 * A), 1.0),
    ],
)
def test_the_column_that_is_called_acceleration_is_read(names: str, columns: tuple[np.ndarray, ...], scale: float) -> None:
    separator = next((sign for sign in ";," if sign in names), " ")
    table = read(made.table(columns, names.split("\n"), separator))
    (found,) = [one for one in table.columns if one.quantity == "acceleration"]
    np.testing.assert_allclose(found.values, scale * A, atol=0.5001e-4)
    assert (found.unit, found.dt) == ("cm/s^2", 0.01)


@pytest.mark.parametrize(
    ("header", "unit", "factor"),
    [
        ("Acceleration in g/10, dt = 0.01 s", "g/10", 1.0),
        ("Acceleration in mg, dt = 0.01 s", "mg", 1.0),
        ("units: 0.05 g, dt = 0.01", "g", 0.05),
    ],
)
def test_a_number_in_the_unit_is_not_lost(header: str, unit: str, factor: float) -> None:
    (column,) = read(made.record(A, [header])).columns
    np.testing.assert_allclose(column.values, factor * A, atol=0.5001e-4)
    assert column.unit == unit and ("0.05 g" in column.applied) == (factor != 1)


def test_an_unknown_unit_stays_as_it_is_written() -> None:
    assert read(made.record(A, ["units: furlong/s2, dt = 0.01"])).columns[0].unit == "furlong/s2"


@pytest.mark.parametrize(
    ("times", "dt", "note"),
    [
        (T, 0.01, "the only unit within"),
        (1000 * T, 0.01, "in ms the step is 0.01 s"),
        (np.arange(400), None, "counts the samples"),
        (1 + np.arange(400), None, "counts the samples"),
        (2e5 * T, None, "in a unit that the file does not state"),
    ],
)
def test_the_unit_of_time_is_found_where_one_alone_fits_and_else_asked_for(
    times: np.ndarray, dt: float | None, note: str
) -> None:
    table = read(made.table([times, A], ["units: gal"]))
    values(table, A)
    assert table.columns[0].dt == dt and note in table.notes[0]


def test_a_sample_number_takes_the_step_of_the_header_and_clocks_are_times() -> None:
    rows = made.table([1 + np.arange(400), A], [])
    assert read(f"Sampling frequency: 100 Hz, units: gal\n{rows}").columns[0].dt == 0.01
    clocks = made.text(["time,acc (gal)", *(f"12:34:{50 + t:06.3f},{a:.4f}" for t, a in zip(T, A, strict=True))])
    assert read(clocks).columns[0].dt == 0.01


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_two_rows_are_times_and_values(end: str) -> None:
    lines = [" ".join(f"{value:.7e}" for value in row) for row in (T, A)]
    table = read("# units: gal" + end + end.join(lines) + end)
    values(table, A)
    assert table.columns[0].dt == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        ("number of points: 401", ("number of samples of 401", "the data have 400")),
        ("Datenpunkte: 4000", ("4000", "400")),
        ("duration: 8 s", ("duration of 8 s", "the data have 4 s")),
        ("Messdauer: 40 s", ("duration of 40 s", "the data have 4 s")),
        ("durée : 2 min", ("duration of 120 s", "4 s")),
        ("sampling rate: 200 Hz", ("time step of 0.005 s", "0.01 s")),
        ("pas de temps: 0,02 s", ("0.02 s", "0.01 s")),
        ("PGA = 190.5 gal", ("peak of 190.5 cm/s^2", "182 cm/s^2")),
        ("Peak acceleration: -1.95 m/s^2 at 1.71 s", ("peak of 195 cm/s^2", "182")),
        ("max. acc. (gal): 182.0 at 2.50 s", ("time of the peak of 2.5 s", "1.71 s")),
        ("maximale Beschleunigung: 18.2 cm/s²", ("18.2 cm/s^2", "182 cm/s^2")),
    ],
)
def test_each_contradiction_of_the_header_names_both_numbers(statement: str, words: tuple[str, ...]) -> None:
    refused(made.record(A, [GAL, statement]), "line 2", *words)


@pytest.mark.parametrize(
    "statement",
    [
        "duration: 4.0 s", "duration: 3.99 s", "record length: 4 s", "Record length: 400 samples", "PGA: 0.1856 g at 1.71 sec",
        "Peak = -182.0 cm/s2 (time 1.71 s)", "Dauer 4,00 s", "significant duration: 1.1 s", "5-95% duration: 0.9 s",
        "full scale: 2 g", "sensitivity (g): 1.0", "filter: 0.1 Hz to 25 Hz", "8 values per line", "number of records: 3",
        "loading rate 0.5 mm/s, step 3 of 7", "Station 5, 34.2 -118.5", "depth 12 km", "1994-01-17",
    ],
)  # fmt: skip
def test_what_agrees_or_states_something_else_does_not_refuse_the_record(statement: str) -> None:
    values(read(made.record(A, [GAL, statement])), A)


def test_a_unit_that_only_the_peak_states_counts_where_the_peak_agrees() -> None:
    assert read(made.record(A, ["dt = 0.01 s", "PGA: 182.0 gal"])).columns[0].unit == "gal"
    assert read(made.record(A, ["dt = 0.01 s", "PGA: 0.18559 g"])).columns[0].unit == ""


def lines_of_five(values: np.ndarray) -> str:
    return "\n".join("".join(f"{value:14.6E}" for value in row) for row in values.reshape(-1, 5))


def test_a_smooth_record_in_lines_of_five_is_read_in_order_without_a_stated_count() -> None:
    record = np.random.default_rng(1).standard_normal(2005).cumsum()[:2000] * np.hanning(2000)
    table = read(f"# {GAL}\n{lines_of_five(record)}\n")
    values(table, record, within=1e-4)
    assert "goes on from line to line" in " ".join(table.notes)


@pytest.mark.parametrize("kind", ["like one another", "independent", "noise"])
def test_columns_without_names_are_not_taken_for_one_record(kind: str) -> None:
    random = np.random.default_rng(2)
    motion = random.standard_normal((400, 5)).cumsum(axis=0)
    columns = {
        "like one another": motion[:, :1] + 0.01 * random.standard_normal((400, 5)),
        "independent": motion,
        "noise": random.standard_normal((400, 5)),
    }[kind]
    table = read(f"# {GAL}\n{lines_of_five(columns)}\n")
    assert len(table.columns) == 6 and "choose the channel" in " ".join(table.notes)
