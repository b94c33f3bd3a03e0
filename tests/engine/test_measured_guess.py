"""A proposed mapping says what names and units say, and admits what it took from magnitudes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings.measured import Mapping, guess, mapping_yaml, names, read
from rths_engine.recordings.measured.names import written_unit
from rths_engine.recordings.measured.roles import ROLES, UNITS, dimension
from tests.engine import measurements as made
from tests.engine.measurements import T, V, X


@pytest.mark.parametrize(
    ("name", "role", "number", "unit"),
    [
        ("Time (sec)", "t", None, "s"),
        ("t_s", "t", None, "s"),
        ("Actuator 2 Force [kip]", "f_meas", 2, "kip"),
        ("velocity_mm_s", "v_meas", None, "mm/s"),
        ("Disp, in", "x_meas", None, "in"),
        ("LVDT_3 (V)", "x_meas", 3, "V"),
        ("Command (mm)", "x_cmd", None, "mm"),
        ("Acceleration floor 3 (m/s/s)", "a_floor", 3, "m/s^2"),
        ("Table Acc (g)", "ag", None, "g"),
        ("Roof Disp (inches)", "x_floor", None, "in"),
        ("Load (lbs)", "f_meas", None, "lb"),
        ("Temp (°C)", "temperature", None, "degC"),
        ("coil current [mA]", "current", None, "mA"),
        ("s2.x_cmd", "x_cmd", 2, ""),
        ("floor4.x", "x_floor", 4, ""),
        ("channel 7 (kN)", "f_meas", 7, "kN"),
        ("remarks", "", None, ""),
    ],
)
def test_a_name_says_role_number_and_unit(name: str, role: str, number: int | None, unit: str) -> None:
    assert names.read(name) == names.Named(role, number, unit)


@given(st.sampled_from(UNITS), st.sampled_from(["{}", "({})", "[{}]", " {} "]))
def test_every_unit_is_read_as_it_is_written(unit: str, written: str) -> None:
    assert written_unit(written.format(unit)) == unit


@given(st.data())
def test_canonical_names_with_any_unit_of_their_role_are_guessed_without_doubt(data: st.DataObject) -> None:
    roles = data.draw(st.lists(st.sampled_from([role for role in ROLES if role != "t"]), min_size=1, max_size=6, unique=True))
    expected, columns = [], [Column("t (s)", T)]
    for role in roles:
        unit = data.draw(st.sampled_from([unit for unit in UNITS if dimension(unit) in ROLES[role].dimensions]))
        number = data.draw(st.integers(1, 9)) if ROLES[role].counts else None
        name = f"{role}.{number}" if number else role
        expected.append((role, number, unit))
        columns.append(Column(f"{name} ({unit})", X))
    found = guess(Table("test", tuple(columns)))
    assert [(one.role, one.number, one.unit) for one in found.mapping.measurements] == expected
    assert not any("magnitude" in reason for reason in found.reasons.values())


@given(st.lists(st.text(max_size=20), min_size=2, max_size=6, unique=True))
def test_any_names_lead_to_a_mapping_that_can_be_written_and_read_or_to_a_refusal(texts: list[str]) -> None:
    signals = (T, X, V, 0 * T, np.full(len(T), np.nan), 3 * X)
    table = Table("test", tuple(Column(name, values) for name, values in zip(texts, signals, strict=False)))
    try:
        found = guess(table)
    except MeasuredError:
        return
    assert Mapping.from_yaml(mapping_yaml.write(found.mapping, found.reasons, found.left_out)) == found.mapping


def test_unnamed_columns_are_told_by_what_ties_them_together() -> None:
    found = guess(read(made.text(), "unnamed.csv"))
    assert [(one.role, one.unit) for one in found.mapping.channels] == [
        ("t", "s"), ("x_meas", "mm"), ("v_meas", "mm/s"), ("f_meas", "kN"),
    ]  # fmt: skip
    assert "only from its magnitude" in found.reasons["column 2"] and "only from its magnitude" in found.reasons["column 4"]
    assert "derivative" in found.reasons["column 3"]


def test_a_lone_unnamed_column_is_a_guess_that_says_so() -> None:
    found = guess(read(made.text(columns=np.column_stack([T, X])), "decay.txt"))
    assert "its meaning is unknown" in found.reasons["column 2"] and "check it" in found.reasons["column 2"]


def test_volts_of_a_quantity_get_a_gain_to_be_corrected() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("load (V)", V))))
    (channel,) = found.mapping.measurements
    assert (channel.role, channel.unit, channel.gain) == ("f_meas", "V", "1 kN/V")
    assert "placeholder" in found.reasons["load (V)"]


def test_a_drive_without_a_unit_is_a_voltage_to_be_checked() -> None:
    found = guess(Table("test", (Column("t", T), Column("qm", X), Column("qg", X), Column("vir", V / 10))))
    assert [(one.column, one.role) for one in found.mapping.channels] == [
        ("t", "t"), ("qm", "x_meas"), ("qg", "x_cmd"), ("vir", "drive"),
    ]  # fmt: skip
    assert found.mapping.channels[-1].unit == "V" and "check it" in found.reasons["vir"]


def test_a_reference_that_the_drive_follows_up_to_its_limits_is_the_drive() -> None:
    cut = np.clip(X, -10.0, 10.0)
    found = guess(Table("test", (Column("t_s", T), Column("reference", X), Column("control", cut), Column("position", V))))
    assert [(one.column, one.role, one.unit) for one in found.mapping.measurements[:1]] == [("reference", "drive", "V")]
    assert found.left_out == {"control": "equals column reference after its limits"}
    assert "within its limits" in found.reasons["reference"]


def test_a_reference_that_the_drive_does_not_follow_stays_a_command() -> None:
    found = guess(Table("test", (Column("t_s", T), Column("reference", X), Column("control", V))))
    assert [(one.column, one.role) for one in found.mapping.measurements] == [("reference", "x_cmd"), ("control", "drive")]


def test_columns_of_one_role_are_numbered_in_turn() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("disp north (mm)", X), Column("disp south (mm)", V))))
    assert [one.key for one in found.mapping.measurements] == ["x_meas.1", "x_meas.2"]


def test_more_columns_than_a_mapping_holds_are_left_out_and_said_so() -> None:
    found = guess(Table("test", tuple(Column(f"disp {k} (mm)", X) for k in range(990, 1190))))
    assert found.mapping.channels[9].number == 999 and found.mapping.channels[10].number == 1
    found = guess(Table("test", tuple(Column(f"disp {k} (mm)", X) for k in range(201))))
    assert len(found.mapping.channels) == 200 and "has at most 200 channels" in found.left_out["disp 200 (mm)"]


def test_a_file_without_any_time_says_what_is_missing() -> None:
    found = guess(Table("test", (Column("disp (mm)", X),)))
    assert found.notes == ("the file does not state its time step: give dt or rate",)


@pytest.mark.parametrize(
    ("signals", "test"),
    [
        (("x_meas (mm)", "f_meas (kN)"), "specimen"),
        (("x_cmd (mm)", "x_meas (mm)"), "actuator"),
        (("ag (g)", "x_floor.1 (mm)"), "structure"),
        (("ag (g)", "x_floor.1 (mm)", "x_meas (mm)"), "hybrid"),
    ],
)
def test_the_kind_of_test_follows_from_what_was_measured(signals: tuple[str, ...], test: str) -> None:
    assert guess(Table("test", (Column("t (s)", T), *(Column(name, X) for name in signals)))).mapping.test == test


def test_the_example_of_the_page_is_a_mapping() -> None:
    page = (Path(__file__).parents[2] / "docs" / "importing.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```yaml\n(.*?)^```", page, re.M | re.S)
    assert Mapping.from_yaml(text).channels[2].scale == (2.5, "kN")
    assert all(f"`{role}`" in page for role in ROLES)
