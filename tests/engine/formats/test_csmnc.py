"""CSMNC: the time of the first sample counts as one step; every number of the header is compared."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.strong_motion.keyed import MISSING
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.csmnc import Record, written

MARKS = {*MISSING, *MARKERS}  # refused where they stand out

VALUES = [float(f"{-17 * np.sin(0.2 * k) * np.exp(-k / 90) + 1e-4:.6e}") for k in range(163)]


def test_values_step_unit_and_component_come_from_the_header() -> None:
    found = table(written(Record(VALUES)))
    column = found.columns[0]
    assert column.values.tolist() == VALUES
    assert (column.name, column.unit, column.dt, column.quantity) == ("65JZC EW", "cm/s^2", 0.005, "acceleration")
    assert found.about["start"] == "2012-01-03T15:39:44.000+08:00" and len(found.statements) == 4


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"count": "170"}, ("line 12", "of 170", "have 163")),
        ({"dt": "0.01"}, ("duration of 0.815 s", "1.62")),
        ({"duration": "60"}, ("line 13", "duration of 60 s")),
        ({"peak": "15.919"}, ("peak of 15.919", "the data have -")),
        ({"at": "0.6"}, ("time of the peak of 0.6 s",)),
        ({"unit": "XYZ"}, ("not gal or cm/s^2", "XYZ")),
        ({"unit": "G"}, ("not gal or cm/s^2", "= g")),
        ({"kind": "VELOCITY"}, ("does not describe a record of acceleration",)),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(VALUES, header=header)), *words)


def test_numbers_without_a_space_between_them_are_refused() -> None:
    lines = written(Record(VALUES)).decode().splitlines()
    lines[20] = lines[20].replace(" ", "")
    refused("\n".join(lines).encode(), "line 21")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*VALUES[:50], -999.0, *VALUES[51:]]
    refused(written(Record(marked)), "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(VALUES)), 71)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(
        st.floats(-1e4, 1e4).map(lambda one: float(f"{one:.6e}")).filter(lambda one: abs(one) not in MARKS),
        min_size=2,
        max_size=60,
    ),
    dt=st.sampled_from([0.005, 0.01]),
)
def test_any_record_comes_back(values: list[float], dt: float) -> None:
    column = table(written(Record(values, dt=dt))).columns[0]
    assert column.values.tolist() == values and column.dt == dt
