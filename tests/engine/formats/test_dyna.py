"""DYNA text of ESM and AFAD: quantity, unit and step by the header; every number of the header is compared."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.strong_motion.keyed import MISSING
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.dyna import Record, written

MARKS = {*MISSING, *MARKERS}  # refused where they stand out

VALUES = [round(-30 * np.sin(0.3 * k) * np.exp(-k / 80), 6) for k in range(150)]
AFAD = {
    "DURATION_S": "", "TIME_PGA_S": "", "PGA_CM/S^2": "28.65", "DATA_TYPE": "Acceleration",
    "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "14/11/2010 23:09:19.300",
}  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "quantity", "unit"),
    [
        ("ACCELERATION", "acceleration", "cm/s^2"),
        ("UNPROCESSED ACCELERATION", "acceleration", "cm/s^2"),
        ("VELOCITY", "velocity", "cm/s"),
        ("DISPLACEMENT", "displacement", "cm"),
    ],
)
def test_quantity_unit_and_step_come_from_the_header(kind: str, quantity: str, unit: str) -> None:
    found = table(written(Record(VALUES, kind=kind)))
    column = found.columns[0]
    assert column.values.tolist() == VALUES
    assert (column.name, column.quantity, column.unit, column.dt) == ("ARS1 HNE", quantity, unit, 0.005)
    assert found.about["start"] == "2019-07-28T16:09:19.870+00:00" and found.about["station"] == "Town Hall,Argos"


def test_the_files_of_afad_state_a_peak_without_sign_and_no_time() -> None:
    stated = f"{max(abs(one) for one in VALUES):.3f}"
    found = table(written(Record(VALUES, header=AFAD | {"PGA_CM/S^2": stated})))
    assert found.about["start"] == "2010-11-14T23:09:19.300+00:00" and len(found.statements) == 2
    refused(written(Record(VALUES, header=AFAD | {"PGA_CM/S^2": "9.999"})), "peak", "9.999 cm/s^2")


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"NDATA": "151"}, ("line 11", "of 151", "have 150")),
        ({"DURATION_S": "1.5"}, ("duration of 1.5 s", "0.7")),
        ({"SAMPLING_INTERVAL_S": "0.01"}, ("duration", "0.75 s")),
        ({"UNITS": "m/s^2"}, ("line 14", "not cm/s^2")),
        ({"PGA_CM/S^2": "30.0"}, ("peak of 30 cm/s^2",)),
        ({"PGA_CM/S^2": f"{max(VALUES, key=abs) * -1:.6f}"}, ("peak of", "the data have -")),
        ({"TIME_PGA_S": "0.500"}, ("time of the peak of 0.5 s",)),
        ({"DATA_TYPE": "ACCELERATION RESPONSE SPECTRUM"}, ("is not a record of acceleration",)),
        ({"SAMPLING_INTERVAL_S": ""}, ("does not state the sampling interval",)),
        ({"NDATA": "many"}, ("line 11", "needs a number")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(VALUES, header=header)), *words)


def test_text_between_the_samples_is_refused_with_its_line() -> None:
    lines = written(Record(VALUES)).decode().splitlines()
    for bad in ("# comment", "1.0 2.0", "*********", "1.501.51"):
        refused("\n".join([*lines[:60], bad, *lines[61:]]).encode(), "line 61")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*VALUES[:50], -999.0, *VALUES[51:]]
    refused(written(Record(marked)), "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(VALUES)), 53)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(
        st.integers(-(10**9), 10**9).map(lambda one: one / 10**6).filter(lambda one: abs(one) not in MARKS),
        min_size=2,
        max_size=60,
    ),
    dt=st.sampled_from([0.001, 0.005, 0.01]),
    kind=st.sampled_from(["ACCELERATION", "VELOCITY", "DISPLACEMENT"]),
)
def test_any_record_comes_back(values: list[float], dt: float, kind: str) -> None:
    column = table(written(Record(values, dt=dt, kind=kind))).columns[0]
    assert column.values.tolist() == values
    assert (column.dt, column.quantity) == (dt, kind.lower())
