"""miniSEED: counts stay counts without a sensitivity; StationXML beside the file gives the unit; gaps are refused."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.strong_motion import mseed
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, MotionError
from rths_engine.parts.ground_motions import channels, read
from tests.engine.formats.reading import refused, table
from tests.engine.formats.writers.mseed import DOUBLES, INTEGERS, START, STEIM1, Channel, station_xml, written

COUNTS = [1800 + round(400000 * np.sin(0.2 * k) * np.exp(-k / 200)) for k in range(500)]
HN1 = Channel("BK.VALB.40.HN1", COUNTS)
EPOCH = ("2012-07-19", "3000-01-01")


def beside(folder: Path, *xml: bytes, channel: Channel = HN1) -> Table:
    """The table of a file in a folder with StationXML files."""
    for number, one in enumerate(xml):
        (folder / f"station{number}.xml").write_bytes(one)
    path = folder / "record.mseed"
    path.write_bytes(written(channel))
    return registry.read(Source(path.name, path=path))


@pytest.mark.parametrize("encoding", [INTEGERS, STEIM1])
def test_without_a_sensitivity_the_samples_stay_counts(encoding: int) -> None:
    late = Channel("BK.VALB.40.HN2", COUNTS[:300], rate=100, start=START + timedelta(seconds=0.5), encoding=encoding)
    found = table(written(Channel(HN1.code, COUNTS, encoding=encoding), late))
    assert [(one.name, one.unit, one.dt, one.start, one.quantity) for one in found.columns] == [
        ("BK.VALB.40.HN1", "counts", 0.005, 0.0, ""),
        ("BK.VALB.40.HN2", "counts", 0.01, 0.5, ""),
    ]
    assert [one.values.tolist() for one in found.columns] == [COUNTS, COUNTS[:300]]
    assert found.about["start"] == "2019-11-03T20:34:52.000+00:00"


@pytest.mark.parametrize(
    ("counts", "unit", "quantity", "si"),
    [
        (427819.0, "M/S**2", "acceleration", 1.0),
        (-4279779.834, "m/s**2", "acceleration", 1.0),
        (0.000428, "nm/s**2", "acceleration", 1e-9),
    ],
)
def test_stationxml_beside_the_file_gives_the_unit(tmp_path: Path, counts: float, unit: str, quantity: str, si: float) -> None:
    column = beside(tmp_path, station_xml((HN1.code, *EPOCH, counts, unit, 200.0))).columns[0]
    expected = (np.array(COUNTS) - np.mean(COUNTS)) / counts * si
    np.testing.assert_allclose(column.values, expected, rtol=1e-12, atol=1e-15)
    assert (column.unit, column.quantity) == ("m/s^2", quantity)
    assert "station0.xml" in column.applied and "is removed" in column.applied


def test_a_seismometer_gives_velocity_which_is_no_ground_motion(tmp_path: Path) -> None:
    channel = Channel("BK.CVS..BHE", COUNTS)
    found = beside(tmp_path, station_xml((channel.code, *EPOCH, 6e8, "M/S", 200.0)), channel=channel)
    assert (found.columns[0].unit, found.columns[0].quantity) == ("m/s", "velocity")
    with pytest.raises(MotionError, match="no channel of acceleration"):
        read(tmp_path / "record.mseed", "record.mseed")


def test_the_epoch_is_chosen_by_the_time_of_the_record(tmp_path: Path) -> None:
    old, now = (HN1.code, "2000-01-01", "2012-07-19", 1.0, "M/S**2", 200.0), (HN1.code, *EPOCH, 2e6, "M/S**2", 200.0)
    column = beside(tmp_path, station_xml(old, now)).columns[0]
    assert np.max(np.abs(column.values)) < 1
    other = beside(tmp_path, station_xml(old), station_xml()).columns[0]
    assert other.unit == "counts"


@pytest.mark.parametrize(
    ("xml", "words"),
    [
        (station_xml((HN1.code, *EPOCH, 2e8, "m", 200.0)), ("accelerometer BK.VALB.40.HN1 for displacement",)),
        (station_xml((HN1.code, *EPOCH, 2e8, "Pa", 200.0)), ("input unit", "not known", "Pa")),
        (station_xml((HN1.code, *EPOCH, 2e8, "m/s**2", 100.0)), ("sampling rate", "100 Hz", "200 Hz")),
        (station_xml((HN1.code, *EPOCH, 2e8, "m/s**2", 200.0), (HN1.code, *EPOCH, 3e8, "m/s**2", 200.0)), ("different",)),
        (b"<FDSNStationXML><Network>", ("not a valid StationXML",)),
        (b"<!DOCTYPE a><FDSNStationXML/>", ("document type",)),
    ],
)
def test_stationxml_that_contradicts_the_record_refuses_the_file(tmp_path: Path, xml: bytes, words: tuple[str, ...]) -> None:
    with pytest.raises(FileError) as caught:
        beside(tmp_path, xml)
    for word in words:
        assert word in str(caught.value)


def test_decimal_samples_have_no_unit_and_no_sensitivity_is_applied(tmp_path: Path) -> None:
    channel = Channel(HN1.code, [one / 7 for one in COUNTS], encoding=DOUBLES)
    found = beside(tmp_path, station_xml((HN1.code, *EPOCH, 2e6, "m/s**2", 200.0)), channel=channel)
    assert found.columns[0].unit == "" and found.columns[0].values.tolist() == list(channel.values)
    assert "not applied" in found.notes[0]


def test_the_person_gives_the_acceleration_of_one_count() -> None:
    raw = written(HN1)
    assert channels(raw, "a.mseed") == ("BK.VALB.40.HN1",)
    with pytest.raises(MotionError, match="counts, not acceleration"):
        read(raw, "a.mseed")
    motion = read(raw, "a.mseed", unit="-2.5e-6 m/s^2")
    np.testing.assert_allclose(motion.acceleration, -2.5e-6 * (np.array(COUNTS) - np.mean(COUNTS)), rtol=1e-12, atol=1e-15)
    assert "is removed" in motion.provenance
    with pytest.raises(MotionError, match="not the acceleration of one count"):
        read(raw, "a.mseed", unit="2.5e-6 mm")
    with pytest.raises(MotionError, match="outside"):
        read(raw, "a.mseed", unit="m/s^2")


def test_gaps_overlaps_and_damage_are_refused() -> None:
    later = Channel(HN1.code, COUNTS, start=START + timedelta(seconds=60))
    refused(written(HN1, later), "gap or an overlap", "500 samples end at")
    refused(written(HN1, HN1), "overlap")
    raw = written(HN1)
    refused(raw[:-100], "cannot be read as miniSEED")
    refused(raw[:512] + raw[1024:], "gap or an overlap")
    steim = bytearray(written(Channel(HN1.code, COUNTS, encoding=STEIM1)))
    steim[150] ^= 0x55
    refused(bytes(steim), "damaged record", "integrity")


def test_a_damaged_file_is_read_or_refused() -> None:
    raw = written(Channel(HN1.code, COUNTS, encoding=STEIM1))
    rng = np.random.default_rng(1)
    for at in rng.integers(0, len(raw), 150):
        damaged = bytearray(raw)
        damaged[at] ^= int(rng.integers(1, 256))
        for part in (bytes(damaged), raw[:at]):
            if part and mseed.looks_like(Source("a", content=part)):
                try:
                    registry.read(Source("a", content=part))
                except FileError as error:
                    assert all(issue.problem for issue in error.issues)


@settings(max_examples=30, deadline=None)
@given(
    counts=st.lists(st.integers(-(2**29), 2**29), min_size=2, max_size=300),
    rate=st.sampled_from([50, 100, 200]),
    encoding=st.sampled_from([INTEGERS, STEIM1]),
)
def test_any_record_comes_back(counts: list[int], rate: int, encoding: int) -> None:
    column = mseed.read(Source("a", content=written(Channel("XX.A..HNZ", counts, rate, encoding=encoding)))).columns[0]
    assert column.values.tolist() == counts and column.dt == 1 / rate and column.name == "XX.A..HNZ"
