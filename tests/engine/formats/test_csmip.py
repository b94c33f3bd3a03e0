"""CSMIP V1 and V2: blocks by quantity, glued columns, pairs read from film, and headers that contradict the data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.csmip import Channel, corrected, file, numbered, uncorrected

N = np.arange(123)
WAVE = np.round(150 * np.sin(N * 0.4) * np.exp(-N / 60), 5)  # cm/s^2
IN_G = np.round(WAVE / 1000, 6)
FILM = np.round(IN_G, 4)  # g/10 is written to three decimals
ALL = Channel(WAVE, velocity=np.round(WAVE / 20, 5), displacement=np.round(WAVE / 300, 5))


def test_v2_gives_acceleration_velocity_and_displacement_of_each_channel() -> None:
    other = Channel(WAVE[:100] / 2, direction="Up", azimuth=500)
    read = table(file(*map(corrected, numbered(ALL, other))))
    assert [(one.name, one.quantity, one.unit) for one in read.columns] == [
        ("24278 90 deg", "acceleration", "cm/s^2"),
        ("24278 90 deg velocity", "velocity", "cm/s"),
        ("24278 90 deg displacement", "displacement", "cm"),
        ("24278 up", "acceleration", "cm/s^2"),
    ]
    np.testing.assert_array_equal(read.columns[0].values, WAVE)
    np.testing.assert_array_equal(read.columns[1].values, ALL.velocity)
    assert {one.dt for one in read.columns} == {0.01}
    assert read.about["station"] == "Castaic - Old Ridge Route"


def test_v2_without_header_values_is_read_and_its_azimuth_is_no_number_of_a_channel() -> None:
    lines = corrected(ALL)
    short = ["Corrected accelerogram", "Chan  1: 90 Deg   Location: roof", *lines[45:]]
    assert [one.name for one in table(file(short)).columns][:2] == ["90 deg", "90 deg velocity"]


def test_v1_in_g_and_pairs_in_tenths_of_g_are_read() -> None:
    column = table(file(uncorrected(Channel(IN_G)))).columns[0]
    np.testing.assert_array_equal(column.values, IN_G)
    assert (column.unit, column.dt, column.name) == ("g", 0.01, "24278 90 deg")
    pairs = table(file(uncorrected(Channel(FILM, dt=0.005), pairs=True))).columns[0]
    np.testing.assert_allclose(pairs.values, FILM * 10, atol=1e-12)
    assert (pairs.unit, pairs.dt) == ("g/10", 0.005)


def test_pairs_that_touch_are_read_and_renadics_peak_counts_from_the_origin() -> None:
    long = np.round(0.3 * np.sin(np.arange(21_000) * 0.05) * np.exp(-np.arange(21_000) / 9000), 4)
    raw = file(uncorrected(Channel(long, dt=0.005), pairs=True, shift=20.6, renadic=True))
    read = table(raw).columns[0]
    assert len(read.values) == 21_000 and read.dt == 0.005
    refused(raw.replace(b"RENADIC", b"OTHER"), "time of the peak")


def test_film_at_uneven_times_is_refused_with_its_steps() -> None:
    lines = uncorrected(Channel(FILM, dt=0.005), pairs=True)
    lines[27] = lines[27].replace("  0.005", "  0.002").replace("  0.010", "  0.013")
    refused(file(lines), "line 28", "uneven times", "0.002 to 0.011 s")


def test_a_peak_that_the_program_kept_with_four_digits_agrees() -> None:
    wave = WAVE.copy()
    wave[4] = 96.534 * 2
    line = "Peak acceleration =    193.100    cm/sec/sec  at     .040   sec."
    assert table(file(corrected(Channel(wave, text={18: line}, reals={66: 193.1})))).columns[0].values[4] == 193.068
    refused(file(corrected(Channel(wave, text={18: line.replace("193.100", "193.200")}))), "line 18", "193.2")


def test_usc_states_peaks_with_the_sign_of_film_and_can_have_a_step_for_each_block() -> None:
    coarse = np.round(WAVE[::2] / 20, 5)
    lines = corrected(Channel(WAVE, velocity=coarse, reals={68: -float(coarse[2]), 67: 0.04}, integers={53: 123}))
    lines[0] = "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0"
    lines[1] = "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:"
    lines[4], lines[5], lines[7] = "STATION USC# 0061   34 17 11N", "BIG TUJUNGA STATION", "COMP N08W"
    lines = ["" if line.startswith("Peak velocity") else line or " " for line in lines]
    lines = [line.replace("veloc data equally spaced at  0.010", "VEL DATA EQUALLY SPACED AT  0.020") for line in lines]
    read = table(file(lines))
    assert [(one.name, one.dt) for one in read.columns] == [("0061 N08W", 0.01), ("0061 N08W velocity", 0.02)]
    lines = [line.replace("Peak acceleration =    ", "Peak acceleration =   -") for line in lines]
    assert "opposite sign" in table(file(lines)).notes[0]


@pytest.mark.parametrize(
    ("channel", "words"),
    [
        (Channel(WAVE, counts={"acceleration": 130}), ("number of samples", "of 130", "have 123")),
        (Channel(WAVE, integers={53: 140}), ("integer header 53", "of 140", "have 123")),
        (Channel(WAVE, text={16: "   150 points of instrument- and baseline-corrected"}), ("line 16", "of 150")),
        (Channel(WAVE, text={17: "At equally-spaced intervals of    .020  sec."}), ("line 17", "0.02 s", "0.01 s")),
        (Channel(WAVE, reals={61: 0.02}), ("time step", "0.01 s", "0.02 s")),
        (Channel(WAVE, reals={60: 9.0}), ("duration", "9 s", "1.23 s")),
        (Channel(WAVE, text={18: "Peak acceleration =   -140.000    cm/sec/sec  at     .040   sec."}), ("peak", "-140 cm/s^2")),
        (Channel(WAVE, text={18: "Peak acceleration =       .143    g  at     .040   sec."}), ("states cm/s^2", "states g")),
        (Channel(WAVE, text={12: "Record length = 9.000 sec."}), ("line 12", "duration", "9 s")),
        (Channel(WAVE, reals={66: 200.0}), ("real header 66", "200 cm/s^2")),
        (Channel(WAVE, reals={65: 0.9}), ("time of the peak", "0.9 s", "0.04 s")),
        (Channel(WAVE, velocity=WAVE / 20, reals={68: 1.0}), ("90 deg velocity", "1 cm/s")),
        (Channel(WAVE, azimuth=180), ("azimuth of 180 deg", "90 deg")),
    ],
)
def test_v2_that_contradicts_itself_is_refused_with_both_numbers(channel: Channel, words: tuple[str, ...]) -> None:
    refused(file(corrected(channel)), *words)


@pytest.mark.parametrize(
    ("channel", "words"),
    [
        (Channel(IN_G, counts={"acceleration": 130}), ("number of samples", "of 130", "have 123")),
        (Channel(IN_G, reals={3: 9.0}), ("duration", "9 s")),
        (Channel(IN_G, reals={7: 0.5}), ("peak", "0.5 g")),
        (Channel(IN_G, reals={8: 0.9}), ("time of the peak", "0.9 s")),
        (
            Channel(IN_G, text={11: "No. of Points = 123  Record Length = 1.23 sec at 200 Samples/sec"}),
            ("sampling rate", "200 Hz", "100 Hz"),
        ),
        (Channel(IN_G, text={12: "Units of uncor data are sec and g/10.     Max  = .1 g, at .04 sec."}), ("states g", "g/10")),
    ],
)
def test_v1_that_contradicts_itself_is_refused_with_both_numbers(channel: Channel, words: tuple[str, ...]) -> None:
    refused(file(uncorrected(channel)), *words)


def test_text_and_lost_numbers_in_a_block_are_refused_with_their_line() -> None:
    lines = corrected(ALL)
    refused(file([*lines[:48], "| note", *lines[49:]]), "line 49", "not a row of numbers")
    refused(file([*lines[:48], lines[48][:50], *lines[49:]]), "line 49", "has 5 numbers")
    refused(file([*lines[:48], "**********" + lines[48][10:], *lines[49:]]), "line 49", "too large")
    refused(file([*lines[:27], *lines[28:]]), "line 26", "19 lines of header values")


def test_pairs_whose_time_stands_still_are_refused() -> None:
    lines = uncorrected(Channel(FILM[:4], dt=0.0), pairs=True)
    refused(file(lines), "line 28", "does not increase")


def test_rates_of_zero_and_empty_blocks_are_refused_or_read_as_empty() -> None:
    lines = uncorrected(Channel(IN_G))
    zero = [line.replace("at 100 pts/sec", "at 0 pts/sec") for line in lines]
    refused(file(zero), "line 28", "not positive")
    refused(file([line.replace("at 0 pts", "at 1E999 pts") for line in zero]), "line 28", "not positive")
    empty = [line.replace("   123 points of accel", "     0 points of accel") for line in corrected(Channel(WAVE))]
    assert len(table(file([*empty[:46]])).columns[0].values) == 0


def test_spectra_are_named_and_refused() -> None:
    refused(b"Response and Fourier amplitude spectra (78 periods, 0.04 -  6.0 sec)   for\n 1 2 3\n", "response spectra", "V2")


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(file(corrected(ALL), uncorrected(Channel(IN_G))), 307)
    never_crashes(file(uncorrected(Channel(FILM), pairs=True)), 211)


@settings(max_examples=40, deadline=None)
@given(
    values=st.lists(st.floats(-990, 990, width=32), min_size=2, max_size=50),
    dt=st.sampled_from([0.005, 0.01, 0.02]),
    azimuth=st.integers(1, 360),
)
def test_any_record_comes_back(values: list[float], dt: float, azimuth: int) -> None:
    exact = np.round(values, 5)
    one = Channel(exact, velocity=exact / 10, dt=dt, azimuth=azimuth, direction=f"{azimuth} Deg")
    read = table(file(corrected(one), corrected(one)))
    for column in read.columns[::2]:
        np.testing.assert_array_equal(column.values, exact)
        assert (column.dt, column.unit) == (dt, "cm/s^2")
    assert read.columns[0].name.startswith(f"24278 {azimuth} deg")
    small = np.round(exact / 1000, 6)
    raw = table(file(uncorrected(Channel(small, dt=dt)))).columns[0]
    np.testing.assert_array_equal(raw.values, small)
    assert (raw.dt, raw.unit) == (dt, "g")
