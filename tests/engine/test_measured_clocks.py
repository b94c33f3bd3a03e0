"""Channels of different clocks on one clock, and the lag between two channels that measure the same thing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.signal import butter, lfilter

from rths_engine.formats.table import Column, Table
from rths_engine.recordings.measured import Mapping, examine, imported, lag, same_motion

DT = 1e-3
FINE = 8  # a lag of a fraction of a sample is a whole number of finer samples


def motion(seed: int, samples: int) -> np.ndarray:
    """Band-limited motion below 5 Hz at FINE times the rate."""
    noise = np.random.default_rng(seed).standard_normal(FINE * samples)
    return np.asarray(lfilter(*butter(4, 5.0, fs=FINE / DT), noise))


def pair(seed: int, lag_samples: float, samples: int = 8000, noise: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """x and y = 2.5 x(t - lag) + noise, the lag in eighths of a sample."""
    fine, moved, first = motion(seed, samples + 4000), round(FINE * lag_samples), FINE * 2000
    x = fine[first : first + FINE * samples : FINE]
    y = 2.5 * fine[first - moved : first - moved + FINE * samples : FINE]
    return x, y + noise * np.std(y) * np.random.default_rng(seed + 1).standard_normal(samples)


@pytest.mark.parametrize("lag_samples", [0.0, 0.125, 12.625, -40.5, 900.25])
def test_a_lag_is_found_to_a_thousandth_of_a_sample_without_noise(lag_samples: float) -> None:
    found = lag.between(*pair(1, lag_samples), DT)
    assert found is not None
    assert found.seconds == pytest.approx(lag_samples * DT, abs=1e-3 * DT)
    assert found.factor == pytest.approx(2.5, rel=1e-4)


def test_the_interval_of_95_percent_holds_the_lag_in_95_percent_of_records() -> None:
    """100 records: 95 expected, standard deviation 2.2; the bound is three of them away."""
    inside = 0
    for seed in range(100):
        found = lag.between(*pair(2 * seed, 20.375, samples=3000, noise=0.05), DT)
        assert found is not None
        inside += found.low <= 20.375 * DT <= found.high
    assert inside >= 88


@pytest.mark.parametrize(
    ("x", "y"),
    [
        (np.zeros(500), np.sin(np.arange(500.0))),
        (np.random.default_rng(1).standard_normal(500), np.random.default_rng(2).standard_normal(500)),
        (np.arange(10.0), np.arange(10.0)),
        (np.full(500, np.nan), np.sin(np.arange(500.0))),
    ],
    ids=["constant", "unrelated", "short", "missing"],
)
def test_no_lag_is_given_where_two_channels_do_not_measure_the_same(x: np.ndarray, y: np.ndarray) -> None:
    assert lag.between(x, y, DT) is None


def recorded(channels: list[dict[str, Any]], **columns: Column) -> tuple[Table, Mapping]:
    table = Table("made", tuple(columns.values()))
    return table, Mapping.read({"channels": channels})


def test_two_clocks_give_a_lag_that_is_offered_and_applied_only_when_the_mapping_says_so() -> None:
    command, measured = pair(3, 25.0, samples=4000, noise=0.01)
    columns = {"x": Column("x", command, "mm", DT), "y": Column("y", measured / 2.5, "mm", DT, start=0.0)}
    channels = [
        {"column": "x", "role": "x_cmd", "unit": "mm", "rate": 1000.0},
        {"column": "y", "role": "x_meas", "unit": "mm", "rate": 1000.0001},
    ]
    table, mapping = recorded(channels, **columns)
    found = imported(table, mapping)
    (offer,) = same_motion.found(found, mapping)
    assert offer.low_s <= 25e-3 <= offer.high_s and not offer.one_clock
    assert "25" in offer.sentence and "different clocks" in offer.sentence
    applied = Mapping.read({"channels": [channels[0], {**channels[1], "lag": offer.lag_s}]})
    again = imported(table, applied)
    (rest,) = same_motion.found(again, applied)
    assert abs(rest.lag_s) < 1e-5
    assert again.get("x_meas", 1).shape == again.get("x_cmd", 1).shape
    moved = {one.key: one.moved for one in again.channels}
    assert moved["x_cmd.1"] == "" and "lag of 25" in moved["x_meas.1"]


def test_columns_of_different_steps_have_different_clocks() -> None:
    command, measured = pair(3, 25.0, samples=4000, noise=0.01)
    channels = [{"column": "x", "role": "x_cmd", "unit": "mm"}, {"column": "y", "role": "x_meas", "unit": "mm"}]
    table, mapping = recorded(channels, x=Column("x", command, "mm", DT), y=Column("y", measured[::2], "mm", 2 * DT))
    examined = examine(table, mapping)
    assert examined.measured is not None
    (offer,) = same_motion.found(examined.measured, mapping, examined.signals)
    assert not offer.one_clock and "different clocks" in offer.sentence


def test_a_lag_on_one_clock_is_said_to_be_of_the_test() -> None:
    command, measured = pair(4, 12.0, samples=4000, noise=0.01)
    channels = [{"column": "x", "role": "x_cmd", "unit": "mm"}, {"column": "y", "role": "x_meas", "unit": "mm"}]
    table, mapping = recorded(channels, x=Column("x", command, "mm", DT), y=Column("y", measured, "mm", DT))
    (offer,) = same_motion.found(imported(table, mapping), mapping)
    assert offer.one_clock and "delay of the test itself" in offer.sentence


def test_a_force_that_is_mass_times_acceleration_is_compared_with_the_acceleration() -> None:
    acceleration, force = pair(5, 3.5, samples=4000, noise=0.02)
    channels = [{"column": "a", "role": "a_floor", "unit": "m/s^2"}, {"column": "f", "role": "f_meas", "unit": "kN"}]
    table, mapping = recorded(channels, a=Column("a", acceleration, "m/s^2", DT), f=Column("f", 40 * force, "kN", DT))
    (offer,) = same_motion.found(imported(table, mapping), mapping)
    assert (offer.ahead, offer.behind) == ("f_meas.1", "a_floor.1") and offer.low_s <= -3.5e-3 <= offer.high_s
    assert offer.factor == pytest.approx(1 / (2.5 * 40e3), rel=0.02)  # 1 / mass


def test_the_start_of_a_column_places_its_samples_in_time() -> None:
    ramp = np.arange(1000.0)
    early, late = Column("a", ramp, "mm", 0.01), Column("b", ramp, "mm", 0.01, start=1.0)
    channels = [{"column": "a", "role": "x_meas", "unit": "mm"}, {"column": "b", "role": "x_cmd", "unit": "mm"}]
    found = imported(*recorded(channels, a=early, b=late))
    assert found.start == 1.0
    np.testing.assert_allclose(found.get("x_meas", 1) - found.get("x_cmd", 1), 0.1, rtol=1e-12)  # 100 samples of 1 mm


def test_a_channel_of_another_rate_says_how_it_was_resampled_and_its_own_samples_are_shown() -> None:
    times = np.arange(4000) * DT
    fast, slow = np.sin(2 * np.pi * times), np.sin(2 * np.pi * times[::4])
    channels = [
        {"column": "a", "role": "x_meas", "unit": "mm", "rate": 1000},
        {"column": "b", "role": "f_meas", "unit": "kN", "rate": 250},
    ]
    table, mapping = recorded(channels, a=Column("a", fast, "mm"), b=Column("b", slow, "kN"))
    found = examine(table, mapping)
    assert found.measured is not None
    moved = {one.key: one.moved for one in found.measured.channels}
    assert moved == {"x_meas.1": "", "f_meas.1": "from 250 Hz to 1000 Hz by a zero-phase polyphase filter"}
    own = next(one for one in found.signals if one.channel.key == "f_meas.1")
    np.testing.assert_array_equal(own.values, 1e3 * slow)
    np.testing.assert_allclose(own.clock.times, times[::4], atol=1e-12)


def test_the_last_sample_stays_where_the_step_of_rounded_stamps_is_rounded() -> None:
    """501 stamps with four decimals whose true step, 0.2002 s, is known to 0.05 of a step over the record."""
    times = np.round(np.arange(501) * 0.20019531, 4)
    channels = [{"column": "t", "role": "t", "unit": "s"}, {"column": "x", "role": "x_meas", "unit": "mm"}]
    found = imported(*recorded(channels, t=Column("t", times), x=Column("x", np.arange(501.0), "mm")))
    np.testing.assert_allclose(found.get("x_meas", 1), 1e-3 * np.arange(501.0), atol=1e-9)
