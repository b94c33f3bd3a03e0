"""K-NET and KiK-net: counts become gal without their offset; direction, start and every number of the header are compared."""

from __future__ import annotations

import io
import tarfile
from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.source import Source
from rths_engine.formats.strong_motion import knet, knet_archive
from rths_engine.foundation.errors import FileError
from rths_engine.parts.ground_motions import channels, read
from tests.engine.formats.reading import never_crashes, refused, table
from tests.engine.formats.writers.knet import Record, written

COUNTS = [900 + round(3000 * np.sin(0.31 * k) * np.exp(-k / 60)) for k in range(200)]


def test_counts_become_gal_without_their_mean() -> None:
    found = table(written(Record(COUNTS)), "AOM0170806140843.NS")
    column = found.columns[0]
    np.testing.assert_allclose(column.values, Record(COUNTS).gal, rtol=0, atol=1e-12)
    assert (column.name, column.unit, column.dt, column.quantity) == ("AOM017 N-S", "gal", 0.01, "acceleration")
    assert "x 3920/6182761 gal" in column.applied and "is removed" in column.applied
    assert found.about["start"] == "2008-06-14T08:44:03.000+09:00"  # the record time less 15 s, Japan
    assert abs(np.mean(column.values)) < 1e-12


def test_a_small_record_with_a_large_offset_becomes_a_motion() -> None:
    counts = [52000 + round(600 * np.sin(0.2 * k)) for k in range(400)]
    motion = read(written(Record(counts, direction="4", factor=(2940, 6170270))), "NGNH31.NS2")
    assert motion.pga * 100 == pytest.approx(max(abs(one) for one in Record(counts, factor=(2940, 6170270)).gal))
    assert motion.dt == 0.01 and motion.component == "AOM017 N-S surface" and "removed" in motion.provenance


def test_a_header_of_a_few_labels_is_enough() -> None:
    lines = written(Record(COUNTS)).decode().splitlines()
    kept = [line for line in lines if line.startswith(("Sampling", "Scale", "Max", "Dir", " "))]
    assert len(table("\n".join(kept).encode()).columns[0].values) == 200


def test_several_directions_in_one_file_are_columns_by_name_with_their_starts() -> None:
    later = Record(COUNTS[:120], direction="E-W", start="2008/06/14 08:44:20")
    found = table(written(Record(COUNTS), later))
    assert [(one.name, one.start, len(one.values)) for one in found.columns] == [
        ("AOM017 N-S", 0.0, 200),
        ("AOM017 E-W", 2.0, 120),
    ]


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"Duration Time(s)": "3"}, ("line 12", "of 300", "have 200")),
        ({"Sampling Freq(Hz)": "200Hz"}, ("number of samples", "of 400", "have 200")),
        ({"Max. Acc. (gal)": "3.333"}, ("line 15", "peak", "3.333 gal")),
        ({"Scale Factor": "2000(gal)/6182761"}, ("peak", "gal")),
        ({"Scale Factor": "2000(g)/6182761"}, ("line 14", "scale factor in gal")),
        ({"Scale Factor": ""}, ("scale factor in gal",)),
        ({"Sampling Freq(Hz)": "0Hz"}, ("line 11", "impossible sampling frequency")),
    ],
)
def test_a_header_that_contradicts_the_data_refuses_the_file(header: dict[str, str], words: tuple[str, ...]) -> None:
    refused(written(Record(COUNTS, header=header)), *words)


def test_the_extension_and_the_direction_must_agree() -> None:
    refused(written(Record(COUNTS, direction="2")), "line 13", "E-W borehole", "N-S", name="NGNH31.NS1")
    refused(written(Record(COUNTS, direction="2")), "E-W borehole", "E-W surface", name="NGNH31.EW2")
    assert table(written(Record(COUNTS, direction="2")), "NGNH31.EW1").columns[0].name.endswith("E-W borehole")


def test_what_is_not_a_count_is_refused_with_its_line() -> None:
    raw = written(Record(COUNTS)).decode().splitlines()
    for bad, word in (("********", "too large"), ("12.5", "not a count"), ("n/a", "row of numbers")):
        damaged = [*raw[:20], bad + raw[20][8:], *raw[21:]]
        refused("\n".join(damaged).encode(), "line 21", word)
    refused("\n".join([*raw[:20], raw[20][:40], *raw[21:]]).encode(), "line 21", "has 4 numbers")


def archive(*files: tuple[str, bytes], mode: Literal["w", "w:gz"] = "w:gz") -> bytes:
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode=mode) as tar:
        for name, content in files:
            info = tarfile.TarInfo(name)
            info.size = len(content)
            tar.addfile(info, io.BytesIO(content))
    return raw.getvalue()


@pytest.mark.parametrize("mode", ["w", "w:gz"])
def test_the_archive_that_nied_delivers_gives_all_directions(mode: Literal["w", "w:gz"]) -> None:
    starts = {"E-W": "2008/06/14 08:44:19", "N-S": "2008/06/14 08:44:18", "U-D": "2008/06/14 08:44:18"}
    three = [
        (f"AOM0170806140843.{name.replace('-', '')}", written(Record(COUNTS, direction=name, start=start)))
        for name, start in starts.items()
    ]
    raw = archive(*three, ("read.me", b"notes"), mode=mode)
    found = table(raw, "AOM0170806140843.tar.gz")
    assert [(one.name, one.start) for one in found.columns] == [("AOM017 E-W", 1.0), ("AOM017 N-S", 0.0), ("AOM017 U-D", 0.0)]
    assert found.notes == ("read.me left out: it is not of K-NET or KiK-net",) and len(found.statements) == 6
    assert channels(raw, "a.tar.gz") == ("AOM017 E-W", "AOM017 N-S", "AOM017 U-D")


def test_an_archive_names_the_file_that_cannot_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    short = written(Record(COUNTS, header={"Duration Time(s)": "3"}))
    bad = archive(("A.EW", written(Record(COUNTS, direction="E-W"))), ("A.NS", short))
    refused(bad, "A.NS, row 12", "of 300", "have 200", name="a.tar.gz")
    stars = written(Record(COUNTS)).replace(b"     900 ", b"******** ", 1)
    refused(archive(("A.NS", stars)), "A.NS, row 18", name="a.tar.gz")
    refused(archive(("a.txt", b"1 2")), "compressed", name="a.tar.gz")
    good = archive(("A.NS", written(Record(COUNTS))))
    refused(good[: len(good) // 2], name="a.tar.gz")
    monkeypatch.setattr(knet_archive, "_LARGEST", 1000)
    refused(good, "compressed", name="a.tar.gz")
    with pytest.raises(FileError, match="more than 1,000 bytes"):
        knet_archive.read(Source("a.tar.gz", content=good))


def test_a_damaged_file_is_read_or_refused() -> None:
    never_crashes(written(Record(COUNTS)), 97)


@settings(max_examples=40, deadline=None)
@given(
    counts=st.lists(st.integers(-(10**7) + 1, 10**7), min_size=8, max_size=80),
    rate=st.sampled_from([1, 2, 4]),
    factor=st.sampled_from([(3920, 6182761), (2940, 6170270), (7845, 8223790)]),
    direction=st.sampled_from([*knet._DIRECTIONS, "N-S", "E-W", "U-D"]),
)
def test_any_record_comes_back(counts: list[int], rate: int, factor: tuple[int, int], direction: str) -> None:
    counts = counts[: len(counts) // rate * rate]
    lasts = {"Duration Time(s)": repr(len(counts) / rate / 25)}
    record = Record(counts, rate=rate * 25, factor=factor, direction=direction, header=lasts)
    column = table(written(record)).columns[0]
    np.testing.assert_allclose(column.values, record.gal, rtol=1e-12, atol=1e-9)
    assert column.dt == 1 / (rate * 25) and column.name == f"AOM017 {knet._DIRECTIONS.get(direction, direction)}"


def test_a_missing_scale_factor_is_named_and_not_the_peak() -> None:
    raw = b"\n".join(line for line in written(Record(COUNTS)).splitlines() if not line.startswith(b"Scale Factor"))
    refused(raw, "does not state a scale factor in gal")
