"""Time that can be meant otherwise, and rows that are no samples of one record: said, and no advice that hides it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings import measured
from rths_engine.recordings.measured import Mapping, Table
from tests.engine.formats.writers import plain as made

T = np.arange(400) / 250
F = 11.4 * np.cos(7 * T)
D = 12.5 * np.sin(7 * T)


def table(t: np.ndarray, name: str = "Time (s)", header: tuple[str, ...] = ()) -> Table:
    heading = f"{name},Force (kN),Disp (mm)"
    return measured.read(made.table([t, np.resize(F, len(t)), np.resize(D, len(t))], [*header, heading]).encode(), "a.csv")


def mapping(unit: str = "", name: str = "Time (s)", **more: Any) -> Mapping:
    signals = [
        {"column": "Force (kN)", "role": "f_meas", "unit": "kN"},
        {"column": "Disp (mm)", "role": "x_meas", "unit": "mm"},
    ]
    return Mapping.read({"channels": [*([{"column": name, "role": "t", "unit": unit}] if unit else []), *signals], **more})


def warnings(of: Table, by: Mapping) -> str:
    return " ".join(map(str, measured.imported(of, by).warnings))


def test_a_unit_of_time_that_only_the_mapping_states_is_doubted() -> None:
    said = warnings(table(T, "Time"), mapping("ms", "Time"))
    assert "250000 Hz in ms" in said
    assert "250 Hz in s" in said
    assert "0.25 Hz in s" in warnings(table(1e3 * T, "Time"), mapping("s", "Time"))
    assert warnings(table(1e3 * T, "Time"), mapping("ms", "Time")) == ""
    assert warnings(table(T), mapping("s")) == ""


def test_a_step_of_the_header_is_held_against_the_unit_of_the_mapping() -> None:
    of = table(1e3 * T, "Time", ("# Sampling rate: 250 Hz",))
    assert "the file states a time step of 0.004 s" in warnings(of, mapping("s", "Time"))
    assert warnings(of, mapping("ms", "Time")) == ""


def test_a_time_that_counts_the_samples_is_doubted() -> None:
    said = warnings(table(np.arange(1.0, 401.0)), mapping("s"))
    assert "counts like a sample number" in said
    assert "1 Hz" in said
    assert warnings(table(np.arange(400.0), "Time (ms)"), mapping("ms", "Time (ms)")) == ""
    assert warnings(table(np.arange(1.0, 401.0)), mapping(rate=250)) == ""


def test_a_second_block_is_named_and_not_hidden_by_a_rate() -> None:
    of = table(np.concatenate([T, T]))
    with pytest.raises(MeasuredError, match="starts again at sample 401: a second block of data") as caught:
        measured.imported(of, mapping("s"))
    assert "leave the column out" not in str(caught.value)
    assert "starts again at sample 401: a second block of data" in warnings(of, mapping(rate=250))


def test_statistics_below_the_data_are_refused_with_their_line() -> None:
    text = made.table([T, F, D], ["Time (s),Force (kN),Disp (mm)"]) + ",11.4,12.5\n,-11.4,-12.5\n"
    with pytest.raises(MeasuredError, match=r"line 402.*has values but no Time"):
        measured.read(text.encode(), "a.csv")


def test_a_rate_that_contradicts_the_time_column_left_out_is_said() -> None:
    assert "has steps of 0.004 s; the mapping says 0.002 s" in warnings(table(T), mapping(rate=500))
    assert warnings(table(T), mapping(rate=250)) == ""


def test_rounded_stamps_may_still_be_replaced_by_a_rate() -> None:
    with pytest.raises(MeasuredError, match="if the stamps are rounded, leave the column out"):
        measured.imported(table(np.floor(T * 50) / 50), mapping("s"))
    assert warnings(table(np.floor(T * 50) / 50), mapping(rate=250)) == ""
