"""A proposed mapping says what names and units say; what the file does not state is asked for, never assumed."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats.table import Column, Table
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings.measured import Mapping, examine, guess, imported, mapping_yaml, names, read
from rths_engine.recordings.measured.mapping import ColumnMap
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
    assert unit_names.known(written.format(unit)) == unit


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
    assert not any("magnitude" in reason or "guess" in reason for reason in found.reasons.values())


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
        ("t", ""), ("x_meas", ""), ("v_meas", ""), ("f_meas", ""),
    ]  # fmt: skip
    assert all(reason.startswith("a guess") for reason in found.reasons.values())
    assert "s would give 200 Hz, ms would give 200000 Hz" in found.reasons["column 1"]
    assert (
        "mm would fit its magnitude" in found.reasons["column 2"] and "kN would fit its magnitude" in found.reasons["column 4"]
    )
    assert "the derivative of column column 2" in found.reasons["column 3"]


def test_a_lone_unnamed_column_is_a_guess_that_says_so() -> None:
    found = guess(read(made.text(columns=np.column_stack([T, X])), "decay.txt"))
    assert "its meaning is unknown" in found.reasons["column 2"] and "check it" in found.reasons["column 2"]


def test_volts_of_a_quantity_ask_for_their_gain() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("load (V)", V))))
    (channel,) = found.mapping.measurements
    assert (channel.role, channel.unit, channel.gain) == ("f_meas", "V", None)
    assert "give the gain of the transducer" in found.reasons["load (V)"]


def test_a_drive_without_a_unit_is_asked_for_its_unit() -> None:
    found = guess(Table("test", (Column("t", T), Column("qm", X), Column("qg", X), Column("vir", V / 10))))
    assert [(one.column, one.role) for one in found.mapping.channels] == [
        ("t", "t"), ("qm", "x_meas"), ("qg", "x_cmd"), ("vir", "drive"),
    ]  # fmt: skip
    assert found.mapping.channels[-1].unit == "" and "V would fit" in found.reasons["vir"]


def test_a_reference_that_the_drive_follows_up_to_its_limits_is_the_drive() -> None:
    cut = np.clip(X, -10.0, 10.0)
    found = guess(Table("test", (Column("t_s", T), Column("reference", X), Column("control", cut), Column("position", V))))
    assert [(one.column, one.role, one.unit) for one in found.mapping.measurements[:1]] == [("reference", "drive", "")]
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
    ("name", "role", "unit"),
    [
        ("Zeit", "t", ""),
        ("Zeit [s]", "t", "s"),
        ("Temps (s)", "t", "s"),
        ("Kraft", "f_meas", ""),
        ("Prüfkraft [kN]", "f_meas", "kN"),
        ("Kolbenweg [mm]", "x_meas", "mm"),
        ("Geschwindigkeit (mm/s)", "v_meas", "mm/s"),
        ("Beschleunigung", "a_floor", ""),
        ("Dehnung", "", ""),
        ("Kraft Sollwert (kN)", "", ""),
        ("MX840 CH 6 [V]", "", ""),
        ("Force (column 11)", "f_meas", ""),
        ("Torque (N·m)", "", ""),
        ("Spannung", "", ""),
        ("Spannung [MPa]", "", ""),
        ("Spannung [V]", "drive", "V"),
        ("Déplacement (mm)", "x_meas", "mm"),
        ("Effort (daN)", "f_meas", "daN"),
        ("Vitesse", "v_meas", ""),
        ("Accélération (m/s²)", "a_floor", "m/s^2"),
        ("Desplazamiento [mm]", "x_meas", "mm"),
        ("Fuerza (kgf)", "f_meas", "kgf"),
        ("Spostamento", "x_meas", ""),
        ("Velocità (m/s)", "v_meas", "m/s"),
        ("Sollweg", "x_cmd", ""),
        ("Udot", "v_meas", ""),
        ("Pr", "f_meas", ""),
        ("Um", "x_meas", ""),
        ("targDsp", "x_cmd", ""),
        ("ctrlDsp", "x_comp", ""),
        ("daqDsp", "x_meas", ""),
        ("daqFrc", "f_meas", ""),
        ("disp", "x_meas", ""),
        ("accel", "a_floor", ""),
        ("X_Value", "t", ""),
        ("Untitled 2", "", ""),
        ("Comment", "", ""),
        ("N_cycles", "", ""),
        ("Axial Segment Count", "", ""),
        ("Zyklen", "", ""),
        ("Sample Number", "", ""),
        ("Actuator disp", "x_meas", ""),
        ("disp_min", "x_meas", ""),
        ("disp_N", "x_meas", ""),
        ("Chan 1: 90 Deg", "", ""),
    ],
)
def test_headings_of_laboratories_are_told_apart(name: str, role: str, unit: str) -> None:
    said = names.read(name)
    assert (said.role, said.unit) == (role, unit)


@pytest.mark.parametrize("name", ["Chan 1: 90 Deg", "acceleration 1: 90 Deg", "Acc 1 N90E", "acc 1 az 360"])
def test_an_azimuth_is_no_number_of_a_floor(name: str) -> None:
    assert names.read(name, "cm/s^2", "acceleration") == names.Named("a_floor", 1, "cm/s^2")


def test_the_headers_unit_is_kept_whatever_the_magnitude() -> None:
    found = guess(Table("test", (Column("Time (s)", T), Column("Force (kgf)", 100 * X), Column("Load 2 (tf)", X))))
    assert [one.unit for one in found.mapping.measurements] == ["kgf", "tf"]
    assert found.reasons["Force (kgf)"] == "by its name and its unit kgf"


@pytest.mark.parametrize(
    ("name", "unit", "told"),
    [
        ("Force (tonf)", "", "the unit 'tonf' has several meanings: choose tf or tonf(US)"),
        ("Force", "furlong", "the unit 'furlong' is not known"),
        ("Force (foo)", "", "the unit 'foo' is not known"),
        ("Force (kg)", "", "kg is a unit of mass: choose the unit of force, such as kgf"),
        ("Force (10 kN)", "", "a factor or the range of a sensor"),
        ("Force", "", "the file states no unit: choose it; kN would fit its magnitude (largest 25)"),
    ],
)
def test_a_unit_that_is_missing_or_not_known_is_asked_for_and_refused_at_the_import(name: str, unit: str, told: str) -> None:
    table = Table("test", (Column("t (s)", T), Column(name, X, unit)))
    found = guess(table)
    assert found.mapping.measurements[0].unit == "" and told in found.reasons[name]
    assert "unit: ''" in mapping_yaml.write(found.mapping)
    with pytest.raises(MeasuredError, match=rf"channels.1.unit: the unit of column '{re.escape(name)}' is not stated: choose"):
        imported(table, found.mapping)


def test_a_role_from_a_name_alone_is_marked_as_a_guess() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("disp", X), Column("force (kN)", V), Column("c (mm)", X))))
    assert found.reasons["disp"].startswith("a guess by its name alone")
    assert found.reasons["force (kN)"] == "by its name and its unit kN"
    assert found.reasons["c (mm)"] == "by its unit mm alone"


def test_a_sample_number_is_never_time() -> None:
    counted = np.arange(1.0, len(T) + 1)
    for name in ("Sample", "Nr.", "column", "Time", "t"):
        found = guess(Table("test", (Column(name, counted), Column("disp (mm)", X))))
        assert "sample number" in found.left_out[name]
        assert found.notes == ("the file does not state its time step: give dt or rate",)
    found = guess(Table("test", (Column("Time (s)", counted), Column("disp (mm)", X))))
    assert [one.role for one in found.mapping.channels] == ["t", "x_meas"]


def test_a_time_without_a_unit_is_asked_for_with_the_rates_that_s_and_ms_would_give() -> None:
    found = guess(Table("test", (Column("Time", 1e3 * T), Column("disp (mm)", X))))
    assert found.mapping.channels[0].unit == "" and "s would give 0.2 Hz, ms would give 200 Hz" in found.reasons["Time"]
    found = guess(Table("test", (Column("Time", 1e3 * T, dt=1 / 200), Column("disp (mm)", X, dt=1 / 200))))
    assert found.mapping.channels[0].unit == "ms" and "the rate of 200 Hz that the file states" in found.reasons["Time"]


def test_units_that_the_file_states_for_quantities_are_used_where_they_agree() -> None:
    columns = (Column("time", T), Column("disp", X), Column("force", V))
    hints = {"displacement": "in", "time": "s", "friction force": "kip", "actuator force": "lb"}
    found = guess(Table("test", columns, hints=hints))
    assert [one.unit for one in found.mapping.channels] == ["s", "in", ""]
    assert "the file gives kip for friction force, lb for actuator force: choose it" in found.reasons["force"]


def test_a_velocity_without_a_unit_names_the_unit_of_the_derivative() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("disp (mm)", X), Column("vel", V))))
    assert found.mapping.measurements[1].unit == "" and "mm/s would fit" in found.reasons["vel"]


def test_the_calibrated_column_is_the_measurement_and_the_volts_beside_it_are_left_out() -> None:
    columns = (Column("Force (V)", -0.4 * X), Column("Force (kN)", X), Column("Disp (V)", V), Column("Disp (mm)", 3 * X))
    found = guess(Table("test", (Column("t (s)", T), *columns)))
    assert [one.key for one in found.mapping.measurements] == ["f_meas.1", "x_meas.1"]
    assert found.left_out["Force (V)"].startswith("is the reading in V of column Force (kN) (gain -2.5 kN/V)")
    assert found.left_out["Disp (V)"] == "is in V; column Disp (mm) of the same name is calibrated in mm"


def test_u_beside_the_columns_of_a_recorder_is_a_displacement() -> None:
    named = ("U", "Udot", "Pr", "Um")
    found = guess(Table("test", (Column("t (s)", T), *(Column(name, X) for name in named))))
    assert [one.role for one in found.mapping.measurements] == ["x_cmd", "v_meas", "f_meas", "x_meas"]
    found = guess(Table("test", (Column("t (s)", T), *(Column(f"Response/{name}", X) for name in named))))
    assert [one.role for one in found.mapping.measurements] == ["x_cmd", "v_meas", "f_meas", "x_meas"]
    found = guess(Table("test", (Column("t (s)", T), Column("U", X))))
    assert [one.role for one in found.mapping.measurements] == ["drive"]


def test_a_strain_or_a_cycle_count_is_left_out_with_the_reason() -> None:
    columns = (Column("disp (mm)", X), Column("Gauge", X, "µε"), Column("N_cycles", X), Column("Gauge 2", X, "µstr"))
    found = guess(Table("test", (Column("t (s)", T), *columns)))
    assert found.left_out["Gauge"] == "is in um/m, a unit of strain, which is the quantity of no role"
    assert "counts cycles" in found.left_out["N_cycles"]
    assert "the unit 'µstr' is not known" in found.left_out["Gauge 2"]


def test_a_unit_with_a_factor_becomes_a_unit_and_a_gain() -> None:
    found = guess(Table("test", (Column("t (s)", T), Column("acc (0.1 g)", X), Column("acc 2 (0.05 g)", X))))
    assert [(one.unit, one.gain) for one in found.mapping.measurements] == [("g/10", None), ("g", "0.05")]


@pytest.mark.parametrize(
    ("name", "unit", "chosen", "warned"),
    [
        ("Force (kgf)", "", "kN", "the file states kgf for column 'Force (kgf)'; the mapping says kN"),
        ("Force", "µstr", "kN", "the unit 'µstr' is not known; the mapping takes column 'Force' as kN"),
        ("Force (kN)", "", "kN", ""),
        ("Force", "Kilonewton", "kN", ""),
        ("Force", "", "kN", ""),
    ],
)
def test_a_header_and_a_mapping_that_differ_in_the_unit_are_flagged(name: str, unit: str, chosen: str, warned: str) -> None:
    table = Table("test", (Column("t (s)", T), Column(name, X, unit)))
    channels = [{"column": "t (s)", "role": "t", "unit": "s"}, {"column": name, "role": "f_meas", "unit": chosen}]
    findings = examine(table, Mapping.read({"channels": channels})).findings
    found = [one.problem for one in findings if one.problem.startswith("the ")]
    assert found == ([warned] if warned else [])


def test_the_gain_that_an_error_suggests_is_one_that_is_read() -> None:
    for unit in ("V", "mV", "V/V", "mV/V", "count"):
        lacks = ColumnMap.model_validate({"column": "x", "role": "f_meas", "number": 1, "unit": unit}).lacks
        assert lacks is not None and lacks.fix is not None
        suggested = lacks.fix.split("'")[1]
        assert suggested.endswith(f"/({unit})" if "/" in unit else f"/{unit}")
        column = ColumnMap.model_validate({"column": "x", "role": "f_meas", "number": 1, "unit": unit, "gain": suggested})
        assert column.lacks is None and column.scale[0] == 2.5


def test_a_reading_takes_a_gain_and_a_ratio_is_one_unit() -> None:
    def scale(unit: str, gain: str) -> tuple[float, str]:
        return ColumnMap.model_validate({"column": "x", "role": "f_meas", "unit": unit, "gain": gain}).scale

    assert scale("mV/V", "35 kN/mV/V") == scale("mV/V", "35 kN/(mV/V)") == (35.0, "kN")
    assert scale("counts", "2e-3 tf/count") == (2e-3, "tf")
    assert scale("V", "2.5 kN/V") == (2.5, "kN")


def test_a_reading_without_its_gain_is_refused_at_the_import() -> None:
    table = Table("test", (Column("t (s)", T), Column("load (V)", X)))
    with pytest.raises(MeasuredError, match=r"needs a unit of force as f_meas, not V \(give a gain such as '2.5 kN/V'\)"):
        imported(table, guess(table).mapping)


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


def test_columns_that_were_measured_at_other_times_are_left_out_with_their_times() -> None:
    x = np.arange(20.0)
    own = {"t 1": np.arange(20.0), "t 2": np.arange(20.0) + 100.0}
    columns = [Column(name, times, "s") for name, times in own.items()]
    columns += [Column(f"Force (block {k})", x * k, "kN", time=f"t {k}") for k in (1, 2)]
    found = guess(Table("test", tuple(columns)))
    assert [one.column for one in found.mapping.channels] == ["t 1", "Force (block 1)"]
    told = "was measured from 100 to 119, the first columns from 0 to 19: import it apart from them"
    assert found.left_out["Force (block 2)"] == told
    steps = [Column("Force (segment 1)", x, "kN", 0.01), Column("Force (segment 2)", x, "kN", 0.01, start=5.0)]
    found = guess(Table("test", tuple(steps)))
    assert [one.column for one in found.mapping.channels] == ["Force (segment 1)"]
    assert "was measured from 5 to 5.19" in found.left_out["Force (segment 2)"]
