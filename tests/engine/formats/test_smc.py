"""SMC files: quantity by the first line, glued numbers, pairs, and headers that contradict the data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.smc import LARGE, Record, written

WAVE = np.array([float(f"{one:.4E}") for one in -150 * np.sin(np.arange(1, 124) * 0.4) * np.exp(-np.arange(123) / 60)])


@pytest.mark.parametrize(("quantity", "unit"), [("acceleration", "cm/s^2"), ("velocity", "cm/s"), ("displacement", "cm")])
def test_values_step_unit_and_direction_come_from_the_header(quantity: str, unit: str) -> None:
    read = table(written(Record(WAVE, quantity=quantity)))
    column = read.columns[0]
    np.testing.assert_array_equal(column.values, WAVE)
    assert (column.quantity, column.unit, column.dt, column.name) == (quantity, unit, 0.01, "SAF0A 90 deg")
    assert read.about["station"] == "San Francisco, 1295 Shafter, F"
    assert table(written(Record(WAVE, azimuth=None))).columns[0].name == "SAF0A up"


def test_pairs_at_uniform_times_are_read_and_at_uneven_times_refused() -> None:
    times = np.arange(123) / 100
    column = table(written(Record(WAVE, rate=None, times=times))).columns[0]
    np.testing.assert_array_equal(column.values, WAVE)
    assert column.dt == 0.01
    refused(written(Record(WAVE, rate=None, times=times**1.1)), "uneven times", "film")
    below = written(Record(WAVE, rate=None, times=times), below=(" 4.9991E+1-1.3800E+1",))
    assert len(table(below).columns[0].values) == 123  # integer header 17 ends the data


@pytest.mark.parametrize(
    ("record", "words"),
    [
        (Record(WAVE, integers={17: 130}), ("number of samples", "of 130", "have 123")),
        (Record(WAVE, integers={16: 1}), ("line 29", "is a comment", "1 lines of comments")),
        (Record(WAVE, integers={14: 180}), ("azimuth of 180 deg", "90 deg")),
        (Record(WAVE, reals={30: 99.0}), ("maximum", "99 cm/s^2")),
        (Record(WAVE, reals={32: -99.0}), ("minimum", "-99 cm/s^2")),
        (Record(WAVE, reals={29: 1.1}), ("time of the maximum", "1.1 s")),
        (Record(WAVE, reals={2: 200.0}), ("time of the maximum", "0.11 s", "0.055 s")),
        (Record(WAVE, pk=99.0), ("line 7", "99 cm/s^2")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(record: Record, words: tuple[str, ...]) -> None:
    refused(written(record), *words)


def test_numbers_that_no_header_can_have_are_refused() -> None:
    refused(written(Record(WAVE, reals={2: 0.0})), "real header 2", "not positive")
    raw = written(Record(WAVE)).replace(b"       123", b"     1E999")
    refused(raw, "does not follow the format")


def test_unknown_extremes_are_not_compared_and_spectra_are_refused() -> None:
    assert len(table(written(Record(WAVE, reals={29: LARGE, 30: LARGE, 31: LARGE, 32: LARGE}))).columns[0].values) == 123
    refused(written(Record(WAVE, title="6 RESPONSE SPECTRA")), "line 1", "response spectra")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(WAVE)), 97)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(st.floats(-980, 980, width=32), min_size=2, max_size=60),
    rate=st.sampled_from([50.0, 100.0, 200.0]),
    azimuth=st.integers(1, 360),
)
def test_any_record_comes_back(values: list[float], rate: float, azimuth: int) -> None:
    exact = np.array([float(f"{one:.4E}") if abs(one) > 1e-8 else 0.0 for one in values])  # one digit of exponent
    column = table(written(Record(exact, rate=rate, azimuth=azimuth))).columns[0]
    np.testing.assert_array_equal(column.values, exact)
    assert (column.dt, column.unit, column.name) == (1 / rate, "cm/s^2", f"SAF0A {azimuth} deg")
