"""Each mistake that a file of measurements can hold is found, where and when it is; sound files raise no doubt."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings.measured import Examined, Finding, Mapping, examine, imported
from tests.engine.measurements import COLUMNS, NAMES, RATE, T, mapping


def examined(columns: np.ndarray = COLUMNS, **more: Any) -> Examined:
    table = Table("test", tuple(Column(name, values) for name, values in zip(NAMES, columns.T, strict=True)))
    return examine(table, Mapping.read(mapping(**more)))


def changed(change: Callable[[np.ndarray], Any]) -> np.ndarray:
    columns = COLUMNS.copy()
    change(columns)
    return columns


def only(found: Examined) -> Finding:
    (finding,) = found.findings
    return finding


def test_a_sound_file_raises_no_doubt() -> None:
    assert examined().findings == ()


def test_noise_and_coarse_readings_raise_no_doubt() -> None:
    rng = np.random.default_rng(1)
    noisy = COLUMNS + rng.normal(size=COLUMNS.shape) * (0, 0.05, 1.0, 0.1)
    assert (
        examined(np.column_stack([T, np.round(noisy[:, 1], 1), np.round(noisy[:, 2]), np.round(noisy[:, 3], 1)])).findings == ()
    )


def _backwards(columns: np.ndarray) -> None:
    columns[500, 0] = columns[498, 0]


def _of_another_age(columns: np.ndarray) -> None:
    columns[:, 0] += 1.7e12  # a date in ms


def _missing_stamp(columns: np.ndarray) -> None:
    columns[500, 0] = np.nan


@pytest.mark.parametrize(
    ("change", "channel", "problem", "time_s"),
    [
        (_backwards, "t (Time (s))", "time does not increase at sample 501", T[499]),
        (_of_another_age, "t (Time (s))", "out of range", None),
        (_missing_stamp, "t (Time (s))", "time stamp 501 is missing", None),
        (lambda c: c.__setitem__((slice(400, 450), 1), np.nan), "x_meas.1", "missing values", T[400]),
        (lambda c: c.__setitem__((slice(None), 3), np.nan), "f_meas.1", "contains no values", None),
        (lambda c: c.__setitem__((slice(None), 2), -c[:, 2]), "v_meas.1", "sign opposite to the derivative of x_meas.1", None),
        (lambda c: c.__setitem__((slice(None), 2), c[:, 2] / 1000), "v_meas.1", "a unit is wrong", None),
    ],
    ids=["time goes back", "date in ms", "stamp missing", "long NaN", "all NaN", "reversed velocity", "m/s taken for mm/s"],
)
def test_what_makes_a_file_unusable_refuses_it(
    change: Callable[[np.ndarray], Any], channel: str, problem: str, time_s: float | None
) -> None:
    finding = only(examined(changed(change)))
    assert (finding.severity, finding.channel, finding.time_s) == ("error", channel, time_s)
    assert problem in finding.problem and finding.fix


@pytest.mark.parametrize(
    ("change", "channel", "problem", "value"),
    [
        (lambda c: c.__setitem__((slice(400, 405), 1), np.nan), "x_meas.1", "missing values", "5 of 1001 samples, 5 in a row"),
        (lambda c: c.__setitem__((slice(None), 3), 2.0), "f_meas.1", "is constant", "2 kN throughout"),
        (lambda c: c.__setitem__((slice(None), 3), np.minimum(c[:, 3], 8.0)), "f_meas.1", "largest value", "at exactly 8 kN"),
        (lambda c: c.__setitem__((slice(None), 3), -c[:, 3]), "f_meas.1", "supplies energy", "%"),
    ],
    ids=["short NaN", "constant", "clipped", "reversed force"],
)
def test_what_may_be_meant_is_a_warning_that_the_recording_keeps(
    change: Callable[[np.ndarray], Any], channel: str, problem: str, value: str
) -> None:
    found = examined(changed(change))
    finding = only(found)
    assert (finding.severity, finding.channel) == ("warning", channel)
    assert problem in finding.problem and value in finding.value
    assert found.measured is not None and found.measured.warnings == (finding,)


def test_a_short_gap_is_bridged_and_told_and_a_long_one_refuses() -> None:
    short = examined(np.delete(COLUMNS, slice(300, 304), axis=0))
    finding = only(short)
    assert finding.severity == "warning" and finding.time_s == pytest.approx(T[299]) and "4 samples missing" in finding.value
    assert short.measured is not None
    # the sine's curvature over five steps of 5 ms, cubic interpolation: far below a hundredth of its 25 mm
    np.testing.assert_allclose(short.measured.get("x_meas", 1), 1e-3 * COLUMNS[:, 1], atol=1e-4)
    finding = examined(np.delete(COLUMNS, slice(300, 330), axis=0)).findings[0]
    assert finding.severity == "error" and "gap too long" in finding.problem and "start or stop" in finding.fix


def test_jittered_time_is_interpolated_and_told() -> None:
    jitter = np.random.default_rng(2).uniform(-0.3, 0.3, len(T)) / RATE
    t = T + jitter
    columns = np.column_stack([t, 25 * np.sin(2 * np.pi * 0.8 * t), 25 * 1.6 * np.pi * np.cos(2 * np.pi * 0.8 * t), np.sin(t)])
    found = examined(columns)
    finding = found.findings[0]
    assert finding.severity == "warning" and "time steps vary" in finding.problem
    assert found.measured is not None
    truth = 0.025 * np.sin(2 * np.pi * 0.8 * found.measured.time)
    np.testing.assert_allclose(found.measured.get("x_meas", 1), truth, atol=2e-6)  # a 5 ms step of a 0.8 Hz sine, third order


def test_stamps_rounded_to_a_microsecond_are_equal_steps() -> None:
    found = examined(changed(lambda c: c.__setitem__((slice(None), 0), np.round(c[:, 0] * 1.0000001, 6))))
    assert found.findings == () and found.measured is not None
    assert found.measured.dt == 1 / RATE


def test_every_error_is_told_at_once() -> None:
    columns = changed(lambda c: c.__setitem__((slice(400, 450), slice(1, 3)), np.nan))
    table = Table("test", tuple(Column(name, values) for name, values in zip(NAMES, columns.T, strict=True)))
    with pytest.raises(MeasuredError) as refusal:
        imported(table, Mapping.read(mapping()))
    assert [issue.where for issue in refusal.value.issues] == ["x_meas.1 at 2 s", "v_meas.1 at 2 s"]


@pytest.mark.parametrize(
    ("mapped", "told"),
    [
        ({"channels": []}, "mapping.channels: needs at least 1 item"),
        ({"channels": [{"column": "x", "role": "x_meas", "unit": "kN"}]}, "needs a unit of length as x_meas, not kN"),
        ({"channels": [{"column": "x", "role": "x_meas", "unit": "V", "gain": "2 mm/A"}]}, "because the column is in V"),
        ({"channels": [{"column": "x", "role": "x_meas", "unit": "furlong"}]}, "not a known unit"),
        ({"channels": [{"column": "x", "role": "x_meas", "unit": "m", "gain": 0}]}, "other than 0"),
        ({"channels": [{"column": "x", "role": "ag", "unit": "g", "number": 1}]}, "ag takes no number"),
        ({"channels": [{"column": "t", "role": "t", "unit": "s"}]}, "maps no measurement"),
        ({"channels": [{"column": "x", "role": "x_meas", "unit": "m"}] * 2}, "x_meas.1 is mapped twice"),
        ({"channels": [{"column": "x", "role": "position", "unit": "m"}]}, "mapping.channels.0.role"),
        ({"channels": [{"column": "x", "role": "ag", "unit": "g"}], "dt": 0.01, "rate": 50}, "contradict each other"),
        ({"channels": [{"column": "x", "role": "ag", "unit": "g"}], "start": 2, "stop": 1}, "needs to be after start"),
    ],
)
def test_a_mapping_that_makes_no_sense_is_refused_with_the_reason(mapped: dict[str, Any], told: str) -> None:
    with pytest.raises(MeasuredError) as refusal:
        Mapping.read(mapped)
    assert told in str(refusal.value)


def test_a_mapping_of_other_columns_names_the_nearest() -> None:
    table = Table("test", (Column("Disp (mm)", T), Column("Force", T)))
    with pytest.raises(MeasuredError) as refusal:
        examine(table, Mapping.read({"channels": [{"column": "Disp", "role": "x_meas", "unit": "mm"}]}))
    assert "mapping.channels.0 = Disp: the file does not have this column (it has Disp (mm))" in str(refusal.value)


def test_values_that_only_a_mistaken_gain_explains_refuse_the_file() -> None:
    data = mapping()
    data["channels"][1]["gain"] = "1e300"
    found = examine(Table("test", tuple(Column(name, COLUMNS[:, k]) for k, name in enumerate(NAMES))), Mapping.read(data))
    assert found.measured is None
    assert [(one.severity, one.channel) for one in found.findings] == [("error", "x_meas.1")]
