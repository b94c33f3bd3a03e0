"""Several time columns in one table: each signal is put on its own clock, or its clock is asked for."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, MeasuredError
from rths_engine.parts import ground_motions
from rths_engine.recordings import measured
from tests.engine.formats.writers import plain as made

T = np.arange(400) / 250
F = 11.4 * np.cos(7 * T)
D = 12.5 * np.sin(7 * T)
HEAD = "Time (s),Force (kN),Time (s),Disp (mm)"


def read(head: str, *columns: np.ndarray, otherwise: str = "columns") -> Table:
    return registry.read(Source("test.csv", content=made.table(columns, [head]).encode()), format=otherwise)


def imported(table: Table) -> measured.Measured:
    return measured.imported(table, measured.guess(table).mapping)


def times(table: Table) -> list[str]:
    return [one.time for one in table.columns if one.quantity != "time"]


def test_a_signal_belongs_to_the_time_column_on_its_left() -> None:
    table = read(HEAD, T, F, 2 * T, D)
    assert times(table) == ["Time (s) (column 1)", "Time (s) (column 3)"]
    guess = measured.guess(table)
    assert guess.left_out["Time (s) (column 3)"] == "the time of Disp (mm)"
    found = imported(table)
    disp = next(one for one in found.channels if one.role == "x_meas").values
    np.testing.assert_allclose(disp[::2], 1e-3 * D[:200], atol=1e-5)  # every second sample of the recording was measured


def test_a_clock_that_starts_later_moves_its_signal() -> None:
    found = imported(read("t_force (s),Force (kN),t_lvdt (s),Disp (mm)", T, F, T + 0.1, D))
    assert found.start == pytest.approx(0.1)
    np.testing.assert_allclose(found.channels[1].values, 1e-3 * D[:375], atol=1e-6)
    np.testing.assert_allclose(found.channels[0].values, 1e3 * F[25:], atol=0.1)


@pytest.mark.parametrize("second", [T, T + 2e-5, T + 1.7e9], ids=["equal", "rounded", "from a date"])
def test_one_clock_written_twice_is_one_clock(second: np.ndarray) -> None:
    table = read(HEAD, T, F, second, D)
    assert times(table) == ["", ""]
    assert imported(table).warnings == ()


def test_a_clock_in_another_unit_is_the_same_clock() -> None:
    assert times(read("t (s),Force (kN),t (ms),Disp (mm)", T, F, 1e3 * T, D)) == ["", ""]
    assert times(read("t (s),Force (kN),t (ms),Disp (mm)", T, F, 2e3 * T, D)) == ["t (s)", "t (ms)"]


def test_the_unit_of_a_second_clock_is_asked_for() -> None:
    with pytest.raises(MeasuredError, match="does not state the unit of this time column"):
        imported(read("t (s),Force (kN),time,Disp (mm)", T, F, 2 * T, D))


def test_clocks_side_by_side_are_asked_for() -> None:
    table = read("t_force (s),t_disp (s),Force (kN),Disp (mm)", T, 2 * T, F, D)
    guess = measured.guess(table)
    assert guess.mapping.times == ()
    assert "times of different clocks" in " ".join(guess.notes)
    with pytest.raises(MeasuredError, match="neither the file nor the mapping states the time step"):
        imported(table)


def test_a_signal_left_of_all_clocks_is_asked_for() -> None:
    assert times(read("Force (kN),t1 (s),Disp (mm),t2 (s)", F, T, D, 2 * T)) == ["", "t1 (s)"]


def test_a_clock_that_ends_before_the_rows_ends_its_signals() -> None:
    half = np.where(np.arange(400) < 200, 2 * T, np.nan)
    table = read(HEAD, T, F, half, np.where(np.arange(400) < 200, D, np.nan))
    assert [len(one.values) for one in table.columns] == [400, 400, 200, 200]


def test_components_of_a_ground_motion_have_their_own_clocks() -> None:
    t = np.arange(400) / 100
    a = 182 * np.sin(9 * t)
    raw = made.table([t, a, 2 * t, 0.8 * a], ["t1 (s),EW (gal),t2 (s),NS (gal)"]).encode()
    assert ground_motions.read(raw, "two.csv", channel=1).dt == pytest.approx(0.01)
    assert ground_motions.read(raw, "two.csv", channel=2).dt == pytest.approx(0.02)
    raw = made.table([t, a, 2e3 * t, 0.8 * a], ["t (s),NS (gal),t (ms),EW (gal)"]).encode()
    assert ground_motions.read(raw, "two.csv", channel=2).dt == pytest.approx(0.02)


def test_components_beside_two_clocks_are_refused() -> None:
    t = np.arange(400) / 100
    with pytest.raises(FileError, match="two time columns with other times"):
        read("t1 (s),t2 (s),EW (gal),NS (gal)", t, 2 * t, np.sin(t), np.cos(t), otherwise="record")


@pytest.mark.parametrize(
    "names", ["N,E,Z", "E,N,Z", "X,Y,Z", "HNE,HNN,HNZ", "NS,EW,UD", "L,T,V", "H1,H2,UP", "Ground,Roof,Base"]
)
@pytest.mark.parametrize("time", ["t", "Time (s)", "time"])
def test_components_are_offered_by_their_names(time: str, names: str) -> None:
    t, a = made.burst()
    raw = made.table([t, a, 0.8 * a, 0.5 * a], ["# units: gal", f"{time},{names}"]).encode()
    found = ground_motions.contents(raw, "three.csv").channels
    assert [one.name for one in found] == names.split(",")
    assert [(one.column.unit, one.column.dt) for one in found] == [("gal", 0.01)] * 3
    assert [float(np.max(np.abs(one.column.values))) for one in found] == pytest.approx([182, 145.6, 91], abs=0.01)


def test_pairs_of_uneven_time_and_value_are_refused() -> None:
    _, a = made.burst()
    uneven = np.cumsum(np.where(np.arange(400) % 3, 0.010, 0.012))
    with pytest.raises(FileError, match="not a time with a uniform step"):
        text = made.table([uneven, a], ["time acc pairs units: cm/s2"], " ")
        registry.read(Source("p.txt", content=text.encode()), format="record")
