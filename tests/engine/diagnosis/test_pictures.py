"""What there is to plot of a diagnosis: shapes, lengths and the numbers behind them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.judge import BLOCKS, HELD_OUT
from rths_engine.diagnosis.locate import place
from rths_engine.diagnosis.pictures import POINTS
from rths_engine.diagnosis.verdict import Diagnosis


def test_the_level_over_time_is_that_of_the_place(played: Diagnosis, shown: Any) -> None:
    (component,) = shown["components"]
    found = place(played.judged[0])
    assert component["over_time"]["level"] == pytest.approx(list(found.level), rel=1e-5)  # six digits
    assert component["over_time"]["time_s"] == pytest.approx(list(found.middle), rel=1e-5)


def test_lines_of_a_plot_are_as_long_as_their_axis_and_no_longer_than_a_screen(shown: Any) -> None:
    detail = shown["components"][0]["detail"]
    (channel,) = detail["channels"]
    for group in ("signals", "residuals", "spectra"):
        lengths = {len(row) for row in channel[group].values()}
        assert len(lengths) == 1 and lengths.pop() <= POINTS + 2  # and both ends
    state = detail["state"]
    count = len(state["measured"])
    assert {len(state[name]) for name in ("before", "after", "residual_before", "residual_after")} == {count}
    assert [len(axis["values"]) for axis in state["axes"]] == [count, count]


def test_extremes_of_what_was_measured_are_kept(played: Diagnosis, shown: Any) -> None:
    drawn = np.array(shown["components"][0]["detail"]["channels"][0]["signals"]["measured"])
    measured = played.judged[0].recordings.data[0].measured[0]
    assert (drawn.min(), drawn.max()) == pytest.approx((measured.min(), measured.max()), rel=1e-5)


def test_blocks_are_a_tenth_each_and_those_held_out_are_told(played: Diagnosis, shown: Any) -> None:
    blocks = shown["components"][0]["detail"]["blocks"]
    data = played.judged[0].recordings.data[0]
    assert len(blocks) == BLOCKS
    assert [number for number, block in enumerate(blocks) if block["held_out"]] == list(HELD_OUT)
    lengths = np.array([block["to_s"] - block["from_s"] for block in blocks])
    assert lengths == pytest.approx(len(data.time) * data.step / BLOCKS, abs=1.5 * data.step)
    assert all(block["after"] < block["before"] for block in blocks)


def test_units_are_told_with_the_factor_to_what_people_read(shown: Any) -> None:
    (channel,) = shown["components"][0]["detail"]["channels"]
    assert (channel["unit"], channel["shown"], channel["factor"]) == ("N", "kN", 1000.0)
    axes = shown["components"][0]["detail"]["state"]["axes"]
    assert [axis["shown"] for axis in axes] == ["mm", "mm/s"]
