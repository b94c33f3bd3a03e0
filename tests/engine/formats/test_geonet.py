"""GeoNet V1A and V2A: blocks of three quantities; times of peaks without the prepended seconds; directions compared."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.geonet import Component, written


def wave(size: float, digits: int, samples: int = 403) -> list[float]:
    return [round(float(size * np.sin(0.05 * k) * np.exp(-((k / 100 - 3) ** 2))), digits) for k in range(samples)]


V2 = Component("N10E", 10, (wave(2364, 1), wave(-298, 2), wave(99, 3)))
V1 = Component("S16W", 196, (wave(-22, 1),), dt=0.005)


def test_each_quantity_of_each_component_is_a_column() -> None:
    up = Component("Up", 0, (wave(1200, 1), wave(90, 2), wave(9, 3)))
    found = table(written(V2, up))
    assert [(one.name, one.quantity, one.unit) for one in found.columns] == [
        ("HSES N10E", "acceleration", "mm/s^2"),
        ("HSES N10E velocity", "velocity", "mm/s"),
        ("HSES N10E displacement", "displacement", "mm"),
        ("HSES Up", "acceleration", "mm/s^2"),
        ("HSES Up velocity", "velocity", "mm/s"),
        ("HSES Up displacement", "displacement", "mm"),
    ]
    assert [one.values.tolist() for one in found.columns] == [*V2.blocks, *up.blocks]
    assert found.about["start"] == "2016-11-13T11:02:15.000+00:00"  # of the buffer, less 5 s that are prepended


def test_volume_1_has_acceleration_alone() -> None:
    found = table(written(V1))
    assert [(one.name, one.dt, one.values.tolist()) for one in found.columns] == [("HSES S16W", 0.005, V1.blocks[0])]
    assert found.about["start"] == "2016-11-13T11:02:20.000+00:00"


def test_a_large_value_has_fewer_digits_than_the_peak_in_the_text() -> None:
    big = [round(one) for one in wave(-11026, 0)]
    text = {14: f"Acceleration:  Peak {min(big) + 0.4:.1f} mm/s/s at {big.index(min(big)) * 0.005:.2f} s  RMS 1.0 mm/s/s"}
    column = table(written(replace(V1, blocks=(big,), text=text))).columns[0]
    assert column.values.tolist() == big


@pytest.mark.parametrize(
    ("component", "words"),
    [
        (replace(V2, integers={34: 403, 28: 190}), ("direction of 190 deg", "N10E, 10 deg")),
        (replace(V2, text={10: "Number of points  500    Duration 8.04 sec"}), ("line 10", "500 points", "403")),
        (replace(V2, text={10: "Number of points  403    Duration 9.04 sec"}), ("line 10", "duration", "9.04 s")),
        (replace(V2, text={11: "Instrument corrected data at 0.010 sec intervals"}), ("line 11", "time step of 0.01 s")),
        (replace(V2, reals={26: 0.01}), ("time step", "0.02 s")),
        (replace(V2, reals={22: 0.0}), ("time of the peak",)),
        (replace(V2, reals={24: 9.0}), ("real header 24", "duration", "of 9 s")),
        (replace(V2, reals={36: 99.0}), ("real header 36", "peak", "99 mm/s/s")),
        (replace(V2, reals={41: 99.0}), ("real header 41", "velocity", "99 mm/s")),
        (replace(V2, reals={47: 2.0}), ("time of the peak of HSES N10E displacement",)),
        (replace(V2, text={15: "Velocity:  Peak 1.00 mm/s at 1.0 s"}), ("line 15", "velocity of 1 mm/s")),
        (replace(V2, text={14: "Acceleration:  Peak 1.0 g at 1.0 s"}), ("line 14", "not mm/s/s")),
        (replace(V1, text={11: "Raw readings in units of 2.00 mm/s/s  at intervals of 0.005 s"}), ("line 11", "1 mm/s/s")),
        (replace(V2, integers={34: 393}), ("line 10", "403 points", "393")),
        (replace(V2, reals={26: 0.0}), ("real header 26", "step in seconds")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(component: Component, words: tuple[str, ...]) -> None:
    refused(written(component), *words)


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(V1), 71)


@settings(max_examples=30, deadline=None)
@given(
    rows=st.lists(
        st.tuples(
            st.integers(-99999, 99999).map(lambda one: one / 10),
            st.integers(-99999, 99999).map(lambda one: one / 100),
            st.integers(-99999, 99999).map(lambda one: one / 1000),
        ),
        min_size=2,
        max_size=60,
    ),
    dt=st.sampled_from([0.005, 0.02]),
)
def test_any_record_comes_back(rows: list[tuple[float, ...]], dt: float) -> None:
    blocks = [list(one) for one in zip(*rows, strict=True)]
    found = table(written(replace(V2, blocks=blocks, dt=dt, prepended=0.0)))
    assert [one.values.tolist() for one in found.columns] == blocks and {one.dt for one in found.columns} == {dt}
