"""Text of the Turkish network: three components side by side, each with its peak in the header."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.strong_motion.keyed import MISSING
from rths_engine.parts.ground_motions import channels, read
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.nsmn import Record, written

MARKS = {*MISSING, *MARKERS}  # refused where they stand out

WAVE = [round(float(182 * np.sin(0.1 * k) * np.exp(-k / 90)), 6) for k in range(160)]
THREE = (WAVE, [round(-0.8 * one, 6) for one in WAVE], [round(0.5 * one, 6) for one in WAVE])


def test_components_side_by_side_are_columns_by_name() -> None:
    found = table(written(Record(THREE)))
    assert [one.name for one in found.columns] == ["0911 N-S", "0911 E-W", "0911 U-D"]
    assert [one.values.tolist() for one in found.columns] == [list(one) for one in THREE]
    assert {(one.unit, one.dt, one.quantity) for one in found.columns} == {("cm/s^2", 0.01, "acceleration")}
    assert found.about["start"] == "2017-07-20T22:31:09.000+00:00"


def test_the_person_chooses_a_component_by_name() -> None:
    raw = written(Record(THREE))
    assert channels(raw, "0911.txt") == ("0911 N-S", "0911 E-W", "0911 U-D")
    assert read(raw, "0911.txt", channel=3).pga * 100 == pytest.approx(max(abs(one) for one in THREE[2]))


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"NUMBER OF DATA": "480"}, ("line 9", "of 480", "have 160")),
        ({"RAW PGA VALUES (gal)": "(N-S) 182.0 (E-W) 1.0 (U-D) 2.0"}, ("line 11", "peak of E-W of 1 cm/s^2")),
        ({"RAW PGA VALUES (gal)": "(X) 182.0"}, ("line 11", "states peaks of X", "N-S, E-W, U-D")),
        ({"SAMPLING INTERVAL (sec)": ""}, ("does not state the sampling interval",)),
        ({"SAMPLING INTERVAL (sec)": "-0.01"}, ("line 10", "impossible sampling interval")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(THREE, header=header)), *words)


def test_an_unknown_unit_and_a_missing_row_of_names_are_refused() -> None:
    raw = written(Record(THREE))
    refused(raw.replace(b"(gal) ", b"(xyz) "), "line 11", "unit that is not gal or cm/s^2", "xyz")
    refused(raw.replace(b"(gal) ", b"(g)   "), "line 11", "unit that is not gal or cm/s^2", " g")
    refused(raw.replace(b"          N-S          E-W          U-D\r\n", b""), "no row of names")
    refused(raw.removesuffix(b"\r\n")[:-13], "ends a row without all of 3")


def test_a_marker_of_a_missing_sample_is_refused() -> None:
    marked = [*WAVE[:50], -9999.0, *WAVE[51:]]
    refused(written(Record((marked, *THREE[1:]))), "marks a missing sample")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(THREE)), 201)


@settings(max_examples=40, deadline=None)
@given(
    rows=st.lists(
        st.tuples(*[st.integers(-(10**9), 10**9).map(lambda one: one / 10**6).filter(lambda one: abs(one) not in MARKS)] * 3),
        min_size=2,
        max_size=40,
    ),
    dt=st.sampled_from([0.005, 0.01, 0.02]),
)
def test_any_record_comes_back(rows: list[tuple[float, ...]], dt: float) -> None:
    values = list(zip(*rows, strict=True))
    found = table(written(Record(values, dt=dt)))
    assert [tuple(one.values) for one in found.columns] == values
    assert {one.dt for one in found.columns} == {dt}


def test_the_sampling_interval_is_read_in_the_unit_of_its_label() -> None:
    raw = written(Record(THREE)).replace(b"SAMPLING INTERVAL (sec) : 0.01", b"SAMPLING INTERVAL (ms) : 10")
    assert b"(ms)" in raw
    assert {one.dt for one in table(raw).columns} == {0.01}
    refused(raw.replace(b"(ms)", b"(xx)"), "unit of the sampling interval", "xx")
