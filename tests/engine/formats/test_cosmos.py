"""COSMOS files: several channels, the step of the data, glued columns, counts, and headers that contradict the data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.cosmos import Channel, written

WAVE = np.round(150 * np.sin(np.arange(123) * 0.4) * np.exp(-np.arange(123) / 60), 5)  # cm/s^2


def test_each_channel_is_a_column_with_station_and_azimuth_and_the_step_of_real_header_62() -> None:
    read = table(written(Channel(WAVE, azimuth=90), Channel(WAVE[:100] / 2, azimuth=None), Channel(-WAVE, azimuth=360)))
    assert [one.name for one in read.columns] == ["NP-1743 90 deg", "NP-1743 up", "NP-1743 360 deg"]
    # real header 34, the step of the raw record, states 0.005 s
    assert {(one.unit, one.dt, one.quantity) for one in read.columns} == {("cm/s^2", 0.01, "acceleration")}
    np.testing.assert_array_equal(read.columns[0].values, WAVE)
    np.testing.assert_array_equal(read.columns[2].values, -WAVE)
    assert (read.about["station"], len(read.columns[1].values)) == ("Petaluma;FS 2", 100)


@pytest.mark.parametrize(("quantity", "unit"), [("velocity", "cm/s"), ("displacement", "cm")])
def test_velocity_and_displacement_are_columns_of_their_quantity(quantity: str, unit: str) -> None:
    column = table(written(Channel(WAVE, quantity=quantity))).columns[0]
    assert (column.quantity, column.unit, column.name) == (quantity, unit, f"NP-1743 90 deg {quantity}")


def test_numbers_that_touch_are_read_by_the_stated_columns() -> None:
    glued = np.where(np.arange(64) % 2, -100.5, -200.25) - np.arange(64.0)
    raw = written(Channel(glued))
    assert b"-200.25000-101.50000" in raw
    np.testing.assert_array_equal(table(raw).columns[0].values, glued)


def test_crlf_trailing_blanks_and_rows_separated_by_blanks_are_read() -> None:
    np.testing.assert_array_equal(table(written(Channel(WAVE), end="   \r\n")).columns[0].values, WAVE)
    lines = written(Channel(np.abs(WAVE))).decode().split("\n")
    trimmed = "\n".join(line.strip() if line.startswith("   ") and "." in line and "=" not in line else line for line in lines)
    np.testing.assert_array_equal(table(trimmed.encode()).columns[0].values, np.abs(WAVE))


def test_the_value_for_unknown_is_the_one_that_line_13_states() -> None:
    reals = {62: -9999.0, 34: 0.01}
    assert table(written(Channel(WAVE, null=-9999.0, reals=reals, stage=1))).columns[0].dt == 0.01
    assert table(written(Channel(WAVE, null=-9999.0, reals=reals))).columns[0].dt is None  # corrected: 34 is of the raw record
    wave = WAVE.copy()
    wave[40] = -999.0
    np.testing.assert_array_equal(table(written(Channel(wave, null=-9999.0))).columns[0].values, wave)
    refused(written(Channel(wave)), "marks a missing sample", "-999.00000")


def test_raw_counts_become_g_by_the_stated_sensitivity_without_their_mean() -> None:
    counts = np.round(WAVE * 100) - 50_000
    reals = {22: 2.0, 42: 1.25, 47: 1.0}
    column = table(written(Channel(counts, stage=0, form=(10, 8, 0, "I"), reals=reals))).columns[0]
    np.testing.assert_allclose(column.values, (counts - counts.mean()) * 2e-6 / 1.25, rtol=1e-12, atol=1e-15)
    assert column.unit == "g" and "2 microvolt / (1.25 V/g x gain 1)" in column.applied
    unscaled = table(written(Channel(counts, stage=0, form=(10, 8, 0, "I")))).columns[0]
    np.testing.assert_array_equal(unscaled.values, counts)
    assert unscaled.unit == "count"


@pytest.mark.parametrize(
    ("channel", "words"),
    [
        (Channel(WAVE, count=124), ("number of samples", "of 124", "have 123")),
        (Channel(WAVE, reals={62: 5.0}), ("duration", "1.23 s", "0.615 s")),
        (Channel(WAVE, reals={63: 2.46}), ("duration", "2.46 s", "1.23 s")),
        (Channel(WAVE, reals={64: -140.0}), ("peak", "real header 64", "-140 cm/s^2", "data have 1")),
        (Channel(WAVE, reals={65: 0.5}), ("time of the peak", "0.5 s", "0.04 s")),
        (Channel(WAVE, reals={66: 20.0}), ("mean", "20 cm/s^2")),
        (Channel(WAVE, text_peak=99.0), ("line 11", "peak", "99 cm/s^2")),
        (Channel(WAVE, integers={2: 2}), ("integer header 2 states velocity", "acceleration")),
        (Channel(WAVE, integers={3: 2}), ("code of unit 4", "integer header 3 the code 2")),
        (Channel(WAVE, integers={54: 180}), ("azimuth of 180 deg", "the text states 90 deg")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(channel: Channel, words: tuple[str, ...]) -> None:
    refused(written(channel), *words)


def test_the_peak_of_the_raw_record_is_compared_only_in_the_unit_of_the_data() -> None:
    lines = written(Channel(WAVE, stage=1)).decode().splitlines()
    for raw, agrees in [("Uncor max =   1033406, at  45.580 sec.", True), ("Uncor max =  99.0 cm/sec2, at  .040 sec.", False)]:
        changed = "\n".join([*lines[:9], f"Raw record length = 1.230 sec, {raw}", *lines[10:]]).encode()
        if agrees:
            assert len(table(changed).columns[0].values) == 123
        else:
            refused(changed, "line 10", "99 cm/s^2")
    longer = "\n".join([*lines[:9], "Raw record length = 210.000 sec, Uncor max =", *lines[10:]]).encode()
    refused(longer, "line 10", "duration", "210 s", "1.23 s")
    raw = written(Channel(np.round(WAVE * 10), stage=0, form=(10, 8, 0, "I"))).decode()
    refused(raw.replace("Raw record\n", "Raw record, Uncor max =   9999, at 1.0 sec.\n").encode(), "line 10", "9999 count")


def test_nothing_in_the_data_is_skipped_or_split() -> None:
    lines = written(Channel(WAVE)).decode().splitlines()
    first = next(at for at, line in enumerate(lines) if " pts, approx" in line) + 1
    for row, words in [
        ("  ********" + lines[first][10:], ("too large for its columns",)),
        (lines[first][:70], ("has 7 numbers; each line but the last has 8",)),
        ("| a comment", ("is not a row of numbers", "| a comment")),
        (lines[first] + "   1.00000", ("has 9 numbers",)),
        ("1.501.51 " + lines[first][10:], ("does not follow the format",)),
        (lines[first][:10] + "          " + lines[first][20:], ("has 7 numbers",)),
    ]:
        changed = [*lines[:first], row, *lines[first + 1 :]]
        refused("\n".join(changed).encode(), f"line {first + 1}", *words)
    refused("\n".join([*lines, "more text"]).encode(), f"line {len(lines) + 1}", "is not the first line of a channel")


def test_a_number_that_lost_its_end_is_refused() -> None:
    lines = written(Channel(WAVE, form=(1, 15, 6, "E"))).decode().splitlines()
    first = next(at for at, line in enumerate(lines) if " pts, approx" in line) + 3
    refused("\n".join([*lines[:first], lines[first][:7], *lines[first + 1 :]]).encode(), f"line {first + 1}", "does not follow")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Channel(WAVE, comments=("|a", " |b")), Channel(WAVE[:60])), 211)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(st.floats(-990, 990, width=32), min_size=2, max_size=60),
    dt=st.sampled_from([0.0025, 0.005, 0.01, 0.02]),
    azimuth=st.integers(1, 360),
    form=st.sampled_from([(8, 10, 5, "f"), (1, 15, 6, "E"), (5, 15, 6, "f"), (6, 13, 6, "f")]),
    stage=st.sampled_from([1, 2]),
)
def test_any_record_comes_back(
    values: list[float], dt: float, azimuth: int, form: tuple[int, int, int, str], stage: int
) -> None:
    digits = f"%.{form[2]}{form[3]}"
    exact = np.array([float(digits % one) for one in values])
    column = table(written(Channel(exact, dt=dt, azimuth=azimuth, form=form, stage=stage))).columns[0]
    np.testing.assert_array_equal(column.values, exact)
    assert (column.dt, column.unit, column.name) == (dt, "cm/s^2", f"NP-1743 {azimuth} deg")
