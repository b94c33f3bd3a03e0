"""BHRC volume 1: values in g/10 below a header that is cut after 70 characters."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.bhrc import Component, written

VALUES = [float(f"{1.9 * np.sin(0.2 * k) * np.exp(-k / 90) + 1e-3:.5e}") for k in range(165)]


def test_components_are_columns_in_g() -> None:
    found = table(written(*(Component(letter, VALUES) for letter in "LVT")))
    assert [one.name for one in found.columns] == ["Ahar L 352 deg", "Ahar V", "Ahar T 82 deg"]
    for one in found.columns:
        np.testing.assert_allclose(one.values, np.array(VALUES) / 10, rtol=1e-12)
        assert (one.unit, one.dt, one.quantity, one.applied) == ("g", 0.005, "acceleration", "g/10 x 0.1 g")
    assert found.about["station"] == "Ahar" and found.about["origin"] == "2012-08-11T12:23:16.000+00:00"


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"points": 170}, ("line 11", "of 170", "have 165")),
        ({"i28": 166}, ("line 15", "of 166", "have 165")),
        ({"duration": 9.0}, ("line 11", "duration", "of 9 s")),
        ({"r3": 9.0}, ("line 21", "duration", "of 9 s")),
        ({"r9": 100.0}, ("duration", "1.6")),
        ({"r9": 0.0}, ("line 22", "sampling rate in Hz")),
        ({"r5": 1.0}, ("unit G/10", "1 g")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, float], words: tuple[str, ...]) -> None:
    refused(written(Component("L", VALUES, header=header)), *words)


def test_another_unit_and_a_cut_file_are_refused() -> None:
    refused(written(Component("L", VALUES, unit="G")), "line 12", "unit G;")
    refused(written(Component("L", VALUES)).removesuffix(b"/&\n"), "the file is cut")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*VALUES[:50], -999.0, *VALUES[51:]]
    refused(written(Component("L", marked)), "line 33", "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Component("L", VALUES)), 71)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(
        st.floats(-20, 20).map(lambda one: float(f"{one:.5e}") if abs(one) > 1e-30 else 0.0), min_size=11, max_size=60
    ),
    rate=st.sampled_from([100.0, 200.0]),
)
def test_any_record_comes_back(values: list[float], rate: float) -> None:
    column = table(written(Component("T", values, rate=rate))).columns[0]
    np.testing.assert_allclose(column.values, np.array(values) / 10, rtol=1e-12)
    assert column.dt == 1 / rate
