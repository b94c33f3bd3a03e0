"""PEER files: quantity and unit by the header, numbers that touch, and text below the samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.foundation.errors import MotionError
from rths_engine.parts.ground_motions import read
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.at2 import written

WAVE = np.array([float(f"{one:.7E}") for one in 0.3 * np.sin(np.arange(123) * 0.4) * np.exp(-np.arange(123) / 60)])


@pytest.mark.parametrize("old", [False, True])
@pytest.mark.parametrize(("quantity", "unit"), [("acceleration", "g"), ("velocity", "cm/s"), ("displacement", "cm")])
def test_the_header_says_quantity_and_unit(quantity: str, unit: str, old: bool) -> None:
    column = table(written(WAVE, quantity=quantity, old=old)).columns[0]
    np.testing.assert_array_equal(column.values, WAVE)
    assert (column.quantity, column.unit, column.dt) == (quantity, unit, 0.01)


@pytest.mark.parametrize("quantity", ["velocity", "displacement"])
def test_vt2_and_dt2_are_no_ground_motion(quantity: str) -> None:
    with pytest.raises(MotionError, match=rf"0 \({quantity}\): has no channel of acceleration"):
        read(written(WAVE, quantity=quantity), "RSN1.AT2")


def test_a_unit_that_no_line_states_is_asked_for() -> None:
    raw = written(WAVE, series="ACCELERATION TIME SERIES")
    assert table(raw).columns[0].unit == ""
    with pytest.raises(MotionError, match="does not state its unit"):
        read(raw, "RSN1.AT2")


def test_signed_numbers_with_exponents_that_touch_are_read_and_others_refused() -> None:
    negative = -np.abs(WAVE) - 0.01
    raw = written(negative, form="%14.7E")
    assert b"E-02-1" in raw
    np.testing.assert_allclose(table(raw).columns[0].values, negative, rtol=1e-7)
    refused(written(negative, form="%8.5f"), "line 5", "nothing separates")
    refused(written(np.abs(negative), form="%13.7E"), "line 5", "nothing separates")
    refused(written(negative, form="%14.7E", count=122), "number of samples of 122", "have 123")


def test_text_below_the_last_sample_is_noted_and_between_the_samples_refused() -> None:
    below = table(written(WAVE) + b"*** End Data ***\n\nData for a made-up component\n")
    assert len(below.columns[0].values) == 123 and "line 30" in below.notes[0] and "End Data" in below.notes[0]
    refused(written(WAVE) + b"more data\n 0.1 0.2 0.3\n", "line 30", "is not a number")
    refused(written(WAVE, count=130) + b"*** End Data ***\n", "line 30", "is not a number")


def test_of_two_headers_the_last_counts_and_prose_names_no_component() -> None:
    old = b"TIME-DOMAIN CORRECTION, OLD HEADER BELOW\nNPTS= 400, DT= .0200 SEC\n"
    column = table(old + written(WAVE)).columns[0]
    assert (column.dt, len(column.values)) == (0.01, 123)
    prose = b"Data for El Centro\n1559 points, listed i.e., 8 points across\n(in units of g)\nNPTS= 123, DT= .01 SEC\n"
    plain = table(prose + b"\n".join(written(WAVE).split(b"\n")[4:])).columns[0]
    assert (plain.name, plain.unit) == ("acceleration", "g")


def test_a_mark_of_missing_samples_and_stars_are_refused() -> None:
    gap = WAVE.copy()
    gap[7] = -999.0
    refused(written(gap), "line 6", "marks a missing sample")
    refused(written(WAVE).replace(b"  0.0000000E+00", b"***************"), "line 5", "is not a number")


def test_numbers_without_a_header_in_a_file_named_at2_are_plain_columns() -> None:
    rows = written(WAVE).decode().splitlines()[4:]
    found = table("\n".join(rows).encode(), "SCS052.AT2")
    assert found.columns[0].dt is None and found.columns[0].unit == ""


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(WAVE), 53)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(st.floats(-5, 5), min_size=1, max_size=60),
    dt=st.sampled_from([0.0025, 0.005, 0.01, 0.02]),
    quantity=st.sampled_from(["acceleration", "velocity", "displacement"]),
    old=st.booleans(),
)
def test_any_record_comes_back(values: list[float], dt: float, quantity: str, old: bool) -> None:
    exact = np.array([float(f"{one:.7E}") for one in values])
    column = table(written(exact, dt, quantity, old=old)).columns[0]
    np.testing.assert_array_equal(column.values, exact)
    assert (column.dt, column.quantity, column.name) == (dt, quantity, "0")
