"""TDMS files come back as an independent writer wrote them: values, scales, units, and each channel's own start and step."""

from __future__ import annotations

import subprocess
import sys
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.laboratory import tdms as reader
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import tdms
from tests.engine.formats.writers.tdms import Channel, waveform

pytest.importorskip("nptdms")
X = 12.5 * np.sin(np.arange(400) / 9)
BEGUN = datetime(2024, 5, 6, 7, 8, 9, tzinfo=UTC)
REALS = st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=60)


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.tdms", "tdms")


def test_two_rates_keep_their_own_start_and_step() -> None:
    fast = waveform(1 / 1024, 0.25, "kN", BEGUN)
    slow = waveform(0.01, 0.0, "mm", BEGUN + timedelta(seconds=2.5))
    table = read(tdms.file([Channel("rig", "force", X, fast), Channel("rig", "stroke", X[:50], slow)]))
    force, stroke = table.columns
    np.testing.assert_array_equal(force.values, X)
    assert (force.unit, force.dt, force.start) == ("kN", 1 / 1024, 0.25)
    assert (stroke.unit, stroke.dt) == ("mm", 0.01) and stroke.start == pytest.approx(2.5, abs=1e-9)


def test_a_linear_scale_is_applied_and_said() -> None:
    scale = {"NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Linear"}
    scale |= {
        "NI_Scale[0]_Linear_Slope": 0.5,
        "NI_Scale[0]_Linear_Y_Intercept": -3.0,
        "NI_Scale[0]_Linear_Input_Source": 0xFFFFFFFF,
    }
    raw = np.arange(20, dtype="<i2")
    column = read(tdms.file([Channel("g", "a", raw, {**waveform(0.1, unit="kN"), **scale})])).columns[0]
    np.testing.assert_array_equal(column.values, 0.5 * raw - 3.0)
    assert column.applied == "scale Linear, Slope 0.5, Y Intercept -3"


def test_the_sign_of_a_bridge_is_said_and_an_unknown_scale_leaves_the_channel_out() -> None:
    bridge = {"NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Strain", "NI_Scale[0]_Strain_Configuration": 10271}
    bridge |= {"NI_Scale[0]_Strain_Poisson_Ratio": 0.3, "NI_Scale[0]_Strain_Gage_Resistance": 350.0}
    bridge |= {"NI_Scale[0]_Strain_Lead_Wire_Resistance": 0.0, "NI_Scale[0]_Strain_Initial_Bridge_Voltage": 0.0}
    bridge |= {"NI_Scale[0]_Strain_Gage_Factor": 2.0, "NI_Scale[0]_Strain_Bridge_Shunt_Calibration_Gain_Adjustment": 1.0}
    bridge |= {"NI_Scale[0]_Strain_Voltage_Excitation": 5.0, "NI_Scale[0]_Strain_Input_Source": 0xFFFFFFFF}
    other = {"NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Wizardry"}
    volts = np.array([0.0, 0.005, -0.005])
    table = read(tdms.file([Channel("g", "gauge", volts, bridge), Channel("g", "b", volts, other)]))
    gauge = table.columns[0]
    assert gauge.values[1] < 0 < gauge.values[2]
    assert "a positive voltage gives a negative strain" in gauge.applied
    assert table.notes == ("channel b is left out: its scale Wizardry is not known",)


def test_an_increment_that_is_no_time_step_is_not_taken_as_one() -> None:
    spectrum = {"wf_increment": 0.5, "wf_start_offset": 0.0, "wf_xname": "Frequency", "wf_xunit_string": "Hz"}
    table = read(tdms.file([Channel("g", "a", X, spectrum), Channel("g", "b", X, {"wf_increment": 1.0})]))
    assert [one.dt for one in table.columns] == [None, None]
    assert table.notes[0] == "channel a states an increment of 0.5 with Frequency Hz: it is not taken as the time step"


def test_a_cut_file_is_refused_with_both_sizes() -> None:
    raw = tdms.file([Channel("g", "a", X, waveform(0.01))], [Channel("g", "a", X)])
    whole = len(tdms.file([Channel("g", "a", X, waveform(0.01))]))
    for cut in range(5, len(raw), 97):
        assert cut == whole or binaries.read_or_refused(reader.read, raw[:cut], "a.tdms") is None
    with pytest.raises(
        FileError, match=rf"states a size of its segments of {len(raw)} bytes; the data have {len(raw) - 8} bytes"
    ):
        read(raw[:-8])


def test_without_the_extra_the_error_names_it() -> None:
    code = (
        "import sys; sys.modules['nptdms'] = None\n"
        "from rths_engine.formats import registry\nfrom rths_engine.formats.source import Source\n"
        "assert not {'asammdf', 'matio', 'pandas'} & set(sys.modules)\n"
        "from rths_engine.formats.laboratory import tdms\n"
        "try: tdms.read(Source('a.tdms', content=b'TDSm' + bytes(60)))\n"
        "except Exception as error: print(error)\n"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "is a TDMS file, for which the package nptdms is needed (.venv/bin/pip install -e '.[formats]')" in told


@settings(max_examples=25)
@given(st.lists(st.tuples(REALS, st.floats(1e-5, 1.0), st.floats(-10, 10)), min_size=1, max_size=4))
def test_any_written_file_gives_its_values_back(records: list[tuple[list[float], float, float]]) -> None:
    channels = [Channel("g", f"c{k}", np.array(v), waveform(dt, start, "kN")) for k, (v, dt, start) in enumerate(records)]
    table = read(tdms.file(channels))
    for column, channel, (values, dt, start) in zip(table.columns, channels, records, strict=True):
        np.testing.assert_array_equal(column.values, values)
        assert (column.name, column.unit, column.dt, column.start) == (channel.name, "kN", dt, start)


RAW = tdms.file([Channel("g", "a", X[:40], waveform(0.01)), Channel("g", "b", X[:40], waveform(0.01))])


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(0, 10**9), st.integers(0, 255)), max_size=6), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.tdms")


@pytest.mark.parametrize(
    ("around", "own", "dt"),
    [
        ({"SampleRate": 250.0}, {}, 0.004),
        ({"Sampling Frequency": "0.25 kHz"}, {}, 0.004),
        ({}, {"fs": 250.0}, 0.004),
        ({"SampleRate": 250.0}, {"dt_ms": 2.0}, 0.002),
        ({"SampleRate": 1000.0}, waveform(0.004), 0.004),
        ({"Rate": 4.0}, {}, None),
    ],
)
def test_a_rate_in_properties_is_the_step_where_no_waveform_states_one(around: Any, own: Any, dt: float | None) -> None:
    table = read(tdms.file([Channel("g", "Force", np.arange(8.0), own)], properties=around))
    assert table.columns[0].dt == dt
    assert bool(table.notes) == (dt is None or bool(around and "wf_increment" in own))


@pytest.mark.parametrize(
    ("own", "told"),
    [
        (waveform(0.004) | {"SampleRate": 500.0}, "SampleRate: states a time step of Force of 0.002 s; the data have 0.004 s"),
        ({"fs": 250.0, "NumSamples": 9.0}, "NumSamples: states a number of samples of Force of 9; the data have 8"),
    ],
)
def test_properties_of_a_channel_that_contradict_it_refuse_the_file(own: Any, told: str) -> None:
    with pytest.raises(FileError) as refusal:
        read(tdms.file([Channel("g", "Force", np.arange(8.0), own)]))
    assert told in str(refusal.value)
