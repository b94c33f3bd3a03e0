"""Numbers and words in the names of columns that are no station, no drive and no measurement of their own."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.recordings import measured
from tests.engine.formats.writers import plain as made

T = np.arange(400) / 250
F = 11.4 * np.cos(7 * T)
D = 12.5 * np.sin(7 * T)


def guessed(head: str, *columns: np.ndarray) -> measured.Guess:
    return measured.guess(measured.read(made.table(columns, [head]).encode(), "a.csv"))


def roles(head: str, *columns: np.ndarray) -> list[str]:
    return [f"{one.role}.{one.number}" for one in guessed(head, *columns).mapping.channels if one.role != "t"]


@pytest.mark.parametrize(
    "head",
    [
        "Time (s),Force (kN) @ 250 Hz,Disp (mm) @ 250 Hz",
        "Time (s),Force filtered 10 Hz (kN),Disp 100 mm stroke (mm)",
        "Time (s),Load cell 500 kN (kN),LVDT 50 (mm)",
        "Time (s),Force 2.5 kN/V (kN),Disp 10 % (mm)",
    ],
)
def test_a_range_or_a_frequency_in_a_name_is_no_station(head: str) -> None:
    assert roles(head, T, F, D) == ["f_meas.1", "x_meas.1"]


def test_numbers_that_count_sensors_are_stations() -> None:
    assert roles("Time (s),LVDT 11 (mm),LVDT 12 (mm)", T, F, D) == ["x_meas.11", "x_meas.12"]
    assert roles("Time (s),Load cell 12 (kN),LVDT 12 (mm)", T, F, D) == ["f_meas.12", "x_meas.12"]
    assert roles("Time (s),Force 2 (kN),Disp 3 (mm)", T, F, D) == ["f_meas.2", "x_meas.3"]
    assert roles("Time (s),acc 2 g,acc 3 g", T, F, D) == ["a_floor.2", "a_floor.3"]


@pytest.mark.parametrize(
    ("raw", "calibrated"),
    [("Kraft roh (V)", "Kraft (kN)"), ("Force (V)", "Force cal. (kN)"), ("Loads (V)", "Force (kN)"), ("F raw (V)", "F (N)")],
)
def test_volts_beside_the_calibrated_column_are_left_out(raw: str, calibrated: str) -> None:
    found = guessed(f"Time (s),{raw},{calibrated},Disp (mm)", T, -0.4 * F, F, D)
    assert [f"{one.role}.{one.number}" for one in found.mapping.measurements] == ["f_meas.1", "x_meas.1"]
    assert "calibrated" in found.left_out[raw]


def test_volts_of_another_station_are_kept() -> None:
    assert roles("Time (s),Force 1 (V),Force 2 (kN)", T, D, F) == ["f_meas.1", "f_meas.2"]


def test_u_in_a_unit_of_length_is_a_displacement() -> None:
    assert roles("t [ms],F [kN],u [mm]", 1e3 * T, F, D) == ["f_meas.1", "x_meas.1"]
    assert roles("t (s),F (kN),u (V)", T, F, D) == ["f_meas.1", "drive.None"]


@pytest.mark.parametrize("name", ["Aux Input 1 (mm)", "Analog Input 3 (V)", "BattV (V)", "Battery (V)", "BattV"])
def test_inputs_and_supplies_of_a_recorder_are_left_out(name: str) -> None:
    found = guessed(f"Time (s),Force (kN),{name}", T, F, D)
    assert "of the recorder by its name" in found.left_out[name]
