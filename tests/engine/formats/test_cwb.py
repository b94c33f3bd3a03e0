"""Text of the Taiwanese network: time and components U, N, E, each with its largest and smallest value in the header."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.strong_motion.keyed import MISSING
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.cwb import Record, written

MARKS = {*MISSING, *MARKERS}  # refused where they stand out

WAVE = [round(float(12 * np.sin(0.15 * k) * np.exp(-k / 90)), 3) for k in range(200)]
THREE = (WAVE, [round(-0.8 * one, 3) for one in WAVE], [round(0.5 * one, 3) for one in WAVE])


def test_components_are_columns_by_name_and_the_time_is_none_of_them() -> None:
    found = table(written(Record(THREE)))
    assert [one.name for one in found.columns] == ["ANP U", "ANP N", "ANP E"]
    assert [one.values.tolist() for one in found.columns] == [list(one) for one in THREE]
    assert {(one.unit, one.dt, one.quantity) for one in found.columns} == {("cm/s^2", 0.01, "acceleration")}
    assert found.about["start"] == "2021-04-18T22:11:30.000+08:00"
    assert found.columns[0].applied == "offset removed by the network"


def test_a_start_without_a_time_zone_is_not_taken_for_a_time_of_taiwan() -> None:
    raw = written(Record(THREE)).replace(b"#StartTime(GMT+08):", b"#StartTime:").replace(b"DCoffset(corr)", b"")
    found = table(raw)
    assert found.about["start"] == "" and found.columns[0].applied == ""


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"RecordLength(sec)": "3"}, ("of 300", "have 200")),
        ({"SampleRate(Hz)": "200"}, ("line 17", "0.01 s", "0.005 s")),
        ({"AmplitudeMAX. N": "   99.000~   -9.447"}, ("maximum of N of 99",)),
        ({"AmplitudeMAX. E": "    5.905~  -55.000"}, ("minimum of E of -55",)),
        ({"AmplitudeMAX. X": "    5.905~  -55.000"}, ("range of X", "U, N, E")),
        ({"AmplitudeUnit": " volts"}, ("line 10", "not gal or cm/s^2", "volts")),
        ({"AmplitudeUnit": " m/s2. DCoffset(corr)"}, ("not gal or cm/s^2", "m/s^2")),
        ({"Data": "5F10.3"}, ("states 5 columns", "names 4")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(THREE, header=header)), *words)


def test_a_time_that_does_not_follow_the_rate_is_refused_with_its_line() -> None:
    times = [k / 100 + (0.02 if k > 100 else 0) for k in range(200)]
    refused(written(Record(THREE, times=times)), "line 117", "1.03 s", "1.01 s")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*WAVE[:50], -9999.0, *WAVE[51:]]
    refused(written(Record((marked, *THREE[1:]))), "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(THREE)), 211)


@settings(max_examples=40, deadline=None)
@given(
    rows=st.lists(
        st.tuples(*[st.integers(-(10**6), 10**6).map(lambda one: one / 1000).filter(lambda one: abs(one) not in MARKS)] * 3),
        min_size=2,
        max_size=40,
    ),
    rate=st.sampled_from([50, 100, 200]),
)
def test_any_record_comes_back(rows: list[tuple[float, ...]], rate: int) -> None:
    values = list(zip(*rows, strict=True))
    found = table(written(Record(values, rate=rate)))
    assert [tuple(one.values) for one in found.columns] == values
    assert {one.dt for one in found.columns} == {1 / rate}
