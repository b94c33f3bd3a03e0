"""Standard acceleration files of Mexico: channels by their directions; peaks of the header within 20 %, with a note."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.strong_motion.keyed import MISSING
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.asa import Record, written

MARKS = {*MISSING, *MARKERS}  # refused where they stand out

WAVE = [round(float(58 * np.sin(0.15 * k) * np.exp(-k / 90)), 4) for k in range(150)]
THREE = (WAVE, [round(-0.8 * one, 4) for one in WAVE], [round(0.5 * one, 4) for one in WAVE])


def test_channels_are_columns_by_direction() -> None:
    found = table(written(Record(THREE)))
    assert [one.name for one in found.columns] == ["ACAC V", "ACAC N00E", "ACAC N90E"]
    assert [one.values.tolist() for one in found.columns] == [list(one) for one in THREE]
    assert {(one.unit, one.dt, one.quantity) for one in found.columns} == {("cm/s^2", 0.005, "acceleration")}
    assert found.about["start"] == "2017-09-19T18:14:18.000+00:00"
    assert found.about["quality"] == "REGISTRO DIGITAL COMPLETO" and not found.notes


@pytest.mark.parametrize("layout", ["3F10.4", "3E16.7"])
@pytest.mark.parametrize("named", [True, False])
def test_layouts_with_and_without_names_above_the_numbers(layout: str, named: bool) -> None:
    names = ("N90E;", "N00E;", "V;+")
    found = table(written(Record(THREE, layout=layout, named=named, names=names)))
    assert [one.name for one in found.columns] == ["ACAC N90E", "ACAC N00E", "ACAC V"]
    np.testing.assert_allclose([one.values for one in found.columns], THREE, rtol=1e-7)


def test_a_peak_that_an_offset_explains_is_accepted_with_both_numbers() -> None:
    stated = max(abs(one) for one in THREE[1])
    peaks = f"/{max(map(abs, WAVE)):.4f}/{-1.05 * stated:.4f}/{max(map(abs, THREE[2])):.4f}"
    found = table(written(Record(THREE, header={"ACEL. MAX.(Gal), C1-C6": peaks})))
    assert len(found.notes) == 1 and "ACAC N00E" in found.notes[0] and f"{stated:g} cm/s^2" in found.notes[0]


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"NUM. TOTAL DE MUESTRAS, C1-C6": "/149/149/149"}, ("of 149", "have 150")),
        ({"DURACION DEL REGISTRO (s), C1-C6": "/9/9/9"}, ("duration of 9 s", "0.75")),
        ({"VEL. DE MUESTREO, C1-C6 (muestras/s)": "/100/100/100"}, ("100 samples/s", "200 samples/s")),
        ({"INTERVALO DE MUESTREO, C1-C6 (s)": "/0.005/0.01/0.005"}, ("0.01 s beside 0.005 s",)),
        ({"ACEL. MAX.(Gal), C1-C6": "/3.272/6.165/-5.469"}, ("peak of ACAC V of 3.272 cm/s^2",)),
        ({"ACEL. MAX.(Gal), C1-C6": "/3.272/6.165"}, ("has 2 values", "3 channels")),
        ({"UNIDADES DE LOS DATOS": "cuentas"}, ("no known unit", "cuentas")),
        ({"NUMERO DE CANALES": "4"}, ("3 columns", "4 channels")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(THREE, header=header)), *words)


def test_counts_under_the_unit_gal_are_refused() -> None:
    counts = [[one * 400 for one in values] for values in THREE]
    stated = "/{:.4f}/{:.4f}/{:.4f}".format(*(max(map(abs, one)) for one in THREE))
    refused(written(Record(counts, layout="3E16.7", header={"ACEL. MAX.(Gal), C1-C6": stated})), "peak of ACAC V")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*WAVE[:50], -9999.0, *WAVE[51:]]
    refused(written(Record((marked, *THREE[1:]))), "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(THREE)), 211)


@settings(max_examples=40, deadline=None)
@given(
    rows=st.lists(
        st.tuples(*[st.integers(-(10**7), 10**7).map(lambda one: one / 10**4).filter(lambda one: abs(one) not in MARKS)] * 3),
        min_size=2,
        max_size=40,
    ),
    dt=st.sampled_from([0.005, 0.01]),
)
def test_any_record_comes_back(rows: list[tuple[float, ...]], dt: float) -> None:
    values = list(zip(*rows, strict=True))
    found = table(written(Record(values, dt=dt)))
    assert [tuple(one.values) for one in found.columns] == values and {one.dt for one in found.columns} == {dt}
