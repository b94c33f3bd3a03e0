"""Marks of missing values that stand within the range of the data, or not far beyond it."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.formats.plain import markers
from rths_engine.foundation.errors import FileError

T = np.arange(400) / 250
SMOOTH = 228 * np.cos(7 * T)


def refused(values: np.ndarray, *words: str) -> None:
    with pytest.raises(FileError) as caught:
        markers.refuse(values, "force", lambda k: k + 2)
    for word in words:
        assert word in str(caught.value), str(caught.value)


def put(values: np.ndarray, at: int, marker: float, times: int = 1) -> np.ndarray:
    values = np.round(values, 4)
    values[at : at + times] = marker
    return values


@pytest.mark.parametrize("marker", [-999.0, 999.0, -9999.0, 9999.99, -99999.0])
@pytest.mark.parametrize("times", [1, 3])
@pytest.mark.parametrize("at", [0, 100, 397])
def test_a_marker_not_far_beyond_the_data_is_refused(marker: float, times: int, at: int) -> None:
    refused(put(SMOOTH, at, marker, times), f"line {at + 2}", f"{marker:g}")


@pytest.mark.parametrize("marker", [-99.0, -999.0, -9999.0])
def test_a_marker_within_the_range_of_the_data_is_refused(marker: float) -> None:
    refused(put(50 * SMOOTH, 20, marker, 3), "line 22", "(3 times)", "beside it stands")


@pytest.mark.parametrize("marker", [32767.0, -32768.0, 65535.0, 8388607.0])
def test_an_overflow_of_a_converter_is_refused(marker: float) -> None:
    refused(put(0.05 * SMOOTH, 77, marker), "line 79", f"{marker:g}", "beside it stands")


def test_a_marker_in_noise_is_refused_where_it_repeats() -> None:
    noise = np.random.default_rng(1).normal(0, 60, 400)
    refused(put(noise, 50, -999.0, 2), "line 52", "(2 times)")


def test_a_marker_in_a_long_signal_is_refused_with_its_line() -> None:
    refused(put(5000 * np.sin(np.arange(300_000) / 40), 200_003, -999.0), "line 200005")


def test_signals_that_reach_the_value_of_a_marker_are_read() -> None:
    step = np.repeat([0.0, 32767.0, 0.0], 100)
    for values in (
        999.0 * np.sin(7 * T) / np.max(np.sin(7 * T)),  # a peak of exactly 999
        np.clip(1500 * np.sin(7 * T), -999.0, 999.0),  # clipped at 999
        np.clip(40_000 * np.sin(7 * T), -32768.0, 32767.0),  # a converter at its limit
        step,  # a switch
        np.arange(1200.0),  # a sample number
        put(np.random.default_rng(2).normal(0, 600, 400), 50, 999.0),  # a value in noise
        np.round(np.linspace(0, 1998, 1999)),
    ):
        markers.refuse(np.asarray(values), "force", lambda k: k)
