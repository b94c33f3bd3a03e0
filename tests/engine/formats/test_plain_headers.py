"""What headers of plain text state (rates, units, factors, peaks, start and end, in several languages), beside the data."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, MotionError
from rths_engine.parts import ground_motions

COUNT = 400
SHAPE = np.round(np.sin(0.3 * np.arange(COUNT)) * np.hanning(COUNT) ** 2 * 182, 3)
SHAPE[171] = 182.0
LEAST = float(SHAPE.min())


def record(header: str, values: np.ndarray = SHAPE, form: str = "%.3f") -> bytes:
    return "\n".join([header, *(form % value for value in values), ""]).encode()


def table(header: str, step: float = 0.004, scale: float = 1.0) -> bytes:
    rows = [f"{step * k:.4f},{scale * 0.05 * one:.4f},{0.01 * k * (COUNT - k):.4f}" for k, one in enumerate(SHAPE)]
    return "\n".join([header, *rows, ""]).encode()


def motion(header: str, **given: object) -> ground_motions.Motion:
    return ground_motions.read(record(header), "made.txt", **given)  # type: ignore[arg-type]


def measured(raw: bytes) -> Table:
    return registry.read(Source("made.csv", content=raw))


@pytest.mark.parametrize(
    ("rate", "step"),
    [
        ("Sampling rate: 1200 samples/min", 0.05),
        ("Sampling rate: 1200 /min", 0.05),
        ("Sampling rate (1/min): 1200", 0.05),
        ("Samples per minute: 1200", 0.05),
        ("sampled at 72000 samples/hour", 0.05),
        ("SPS: 100", 0.01),
        ("SAMPLES/SEC=100", 0.01),
        ("Sample Rate,0.1,kS/s", 0.01),
        ("Sampling rate: 0.1 kilosamples per second", 0.01),
        ("Sampling interval,10,ms", 0.01),
        ("Örnekleme aralığı (s): 0.01", 0.01),
        ("Örnekleme frekansı: 100 Hz", 0.01),
        ("サンプリング周波数: 100 Hz", 0.01),
        ("サンプリング周波数：１００Hz", 0.01),
        ("采样频率: 100 Hz", 0.01),
    ],
)
def test_a_rate_is_read_in_its_own_unit_and_language(rate: str, step: float) -> None:
    found = motion(f"# units: cm/s2\n# {rate}")
    assert found.dt == pytest.approx(step)
    assert np.max(np.abs(found.acceleration)) == pytest.approx(1.82)


def test_the_exponent_of_a_unit_is_no_rate() -> None:
    assert motion("UNITS=CM/SEC**2 SAMPLES/SEC=100 NO OF POINTS= 400").dt == 0.01
    assert motion("UNITS=CM/SEC^2 SAMPLES/SEC=20 NO OF POINTS= 400").dt == 0.05


@pytest.mark.parametrize(
    "rate",
    [
        "Sampling rate: 1,200 Hz",
        "Sampling rate: 1200 cycles/day",
        "Sampling rate: 1000 Hz, decimation 4",
        "dt = 0.01 s\n# every 4th sample",
    ],
)
def test_a_rate_that_is_not_clear_is_asked_for_and_named(rate: str) -> None:
    contents = ground_motions.contents(record(f"# units: cm/s2\n# {rate}"), "made.txt")
    assert contents.channels[0].asks == ("dt",)
    assert any("not used" in note for note in contents.table.notes)


@pytest.mark.parametrize(
    ("lines", "numbers"),
    [
        ("Max: 170.0  Min: -182.0", ("170",)),
        ("Max value: 182.0 cm/s2, Min value: -250.0 cm/s2", ("-250",)),
        ("Minimum: -282.0 cm/s2", ("-282",)),
        ("abs max 282.0 cm/s2", ("282", "182")),
        ("Aceleração máxima: 282,0 cm/s2", ("282", "182")),
        ("最大值: 192.0", ("192", "182")),
        ("最大加速度: 282.0 gal", ("282", "182")),
        ("En büyük ivme: 282.0 cm/s2", ("282", "182")),
        ("Maximale Beschleunigung: 282,0 cm/s2", ("282", "182")),
        ("Veri sayısı: 500", ("500", "400")),
        ("データ数: 500", ("500", "400")),
        ("ﾃﾞｰﾀ数: 500", ("500", "400")),
        ("Start time: 10:00:00.000  End time: 10:00:08.000", ("8 s", "4 s")),
        ("Start: 0.0 s  End: 7.98 s", ("7.98 s", "4 s")),
        ("tmax = 7.98 s", ("7.98 s", "4 s")),
        ("Start time: 23:59:58.0\n# Stop time: 00:00:06.0", ("8 s", "4 s")),
    ],
)
def test_a_header_that_contradicts_the_record_refuses_it_with_both_numbers(lines: str, numbers: tuple[str, ...]) -> None:
    with pytest.raises(MotionError) as caught:
        motion(f"# units: cm/s2, dt=0.01\n# {lines}")
    assert all(number in str(caught.value) for number in numbers), str(caught.value)


@pytest.mark.parametrize(
    "lines",
    [
        f"Max: 182.0  Min: {LEAST}",
        f"Minimum: {LEAST} cm/s2",
        f"Minimum value: {-LEAST} cm/s2",
        "abs max 182.0 cm/s2",
        "En büyük ivme: 182.0",
        "Start time: 10:00:00.000  End time: 10:00:04.000",
        "Start: 0.0 s  End: 3.99 s",
        "tmax = 3.99 s",
        "HOUR=14 MIN=42 SEC=10",
        "Scale factor: 1.0",
        "Instrument gain: 1000",
        "Maximum load capacity: 100 kN",
        "Max. range: 2 g",
        "Start frequency: 0.1 Hz, end frequency: 20 Hz",
        "Original record in g",
        "Decimation: 1",
    ],
)
def test_a_header_that_agrees_is_read(lines: str) -> None:
    found = motion(f"# units: cm/s2, dt=0.01\n# {lines}")
    assert (found.dt, np.max(np.abs(found.acceleration))) == pytest.approx((0.01, 1.82))


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ("# Acceleration in cm/s2\n# Units: g\n# dt = 0.01", ("cm/s2", " g")),
        ("Ground acceleration [m/s2]\nUnits: cm/s2\ndt: 0.01 s", ("m/s2", "cm/s2")),
        ("Units: gal\nUnit: g\ndt: 0.01 s", ("gal", " g")),
        ("# units: cm/s2, dt = 0.01\n# Scale factor: 0.1", ("line 2", "scale factor: 0.1")),
        ("# units: g, dt = 0.01 s, multiply by 0.1", ("line 1", "multiply by 0.1")),
        ("# units: gal, dt = 0.01, gain = 10", ("gain = 10",)),
        ("# units: cm/s2 x 10, dt = 0.01", ("cm/s2 x 10",)),
        ("# units: micro g, dt = 0.01", ("micro g",)),
    ],
)
def test_units_that_contradict_each_other_and_factors_are_named(header: str, words: tuple[str, ...]) -> None:
    with pytest.raises(MotionError) as caught:
        motion(header)
    assert all(word in str(caught.value) for word in words), str(caught.value)


@pytest.mark.parametrize(
    "header",
    [
        "# counts, 1 count = 0.1 cm/s2, dt = 0.01 s",
        "Units: counts\nScale factor: 0.1 gal/count\ndt: 0.01 s",
        "Units: counts\nSensitivity: 10 counts/gal\ndt: 0.01 s",
        "# raw counts, 0.1 cm/s2 per count, dt = 0.01 s",
        "# Data in counts; LSB = 0.1 gal; dt = 0.01 s",
    ],
)
def test_counts_have_the_unit_of_one_count_that_the_header_states(header: str) -> None:
    found = ground_motions.read(record(header, np.round(10 * SHAPE), "%.0f"), "made.txt")
    assert np.max(np.abs(found.acceleration)) == pytest.approx(1.82)


def test_a_list_of_units_belongs_to_columns_or_to_blocks() -> None:
    listed = "NO OF POINTS= 400, UNITS=CM/SEC**2, CM/SEC, AND CM, dt=0.01"
    columns = "\n".join([listed, *(f"{one:.3f} {0.1 * one:.3f} {0.01 * one:.3f}" for one in SHAPE)])
    blocks = "\n".join(
        f"DATA TYPE={kind}\n{record(listed, scale * SHAPE).decode()}" for kind, scale in (("AC", 1), ("VL", 0.1), ("DP", 0.01))
    )
    for text in (columns, blocks):
        contents = ground_motions.contents(text.encode(), "made.txt")
        assert [one.quantity for one in contents.table.columns] == ["acceleration", "velocity", "displacement"]
        assert len(contents.channels) == 1


def test_pairs_with_uneven_times_are_no_record_of_two_values_a_line() -> None:
    times = 0.01 * np.arange(COUNT) + 0.002 * (np.arange(COUNT) % 3)
    text = "\n".join(["time acc pairs units: cm/s2", *(f"{t:.4f} {one:.4f}" for t, one in zip(times, SHAPE, strict=True))])
    with pytest.raises(MotionError, match="not a time with a uniform step"):
        ground_motions.contents(text.encode(), "made.txt")


def test_a_line_of_units_above_the_names_is_no_row_of_units() -> None:
    text = "# Sampling rate: {} Hz\n# Units: kN mm\nTime (s),Force,Disp"
    with pytest.raises(FileError, match=r"0\.002 s; the data have 0\.004 s"):
        measured(table(text.format(500)))
    found = measured(table(text.format(250)))
    assert [(one.name, one.unit) for one in found.columns] == [("Time (s)", "s"), ("Force", "kN"), ("Disp", "mm")]


@pytest.mark.parametrize(
    ("header", "units"),
    [
        ("# units: kN\nTime (ms),Force,Disp", ["ms", "", ""]),
        ("# units: s, kN, mm\nTime,Force,Disp", ["s", "kN", "mm"]),
        ("# units: kN; mm\nTime (s),Force,Disp (mm)", ["s", "kN", "mm"]),
        ("Time (s),Force,Disp\n# units: kN, mm", ["s", "kN", "mm"]),
        ("# units: gal\nTime (s),acc,Disp", ["s", "gal", ""]),
    ],
)
def test_a_line_of_units_gives_units_to_columns_without_one(header: str, units: list[str]) -> None:
    assert [one.unit for one in measured(table(header)).columns] == units


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ("# Units: N, m\nTime (s),Force (kN),Disp (mm)", ("line 1", "unit N", "Force states kN")),
        ("# units: kN\nTime (s),Force (N),Disp (mm)", ("unit kN", "Force states N")),
        ("Time (s),Force (kN),Disp (mm)\ns,N,mm", ("states kN in the name of Force and N in the row",)),
        ("Time (s);Force (kN)".replace(";", ",") + ",Disp (mm)\nms,kN,mm", ("states s in the name of Time and ms",)),
        ("Fmax [kN],25.0\nZeit (s),Kraft (kN),Weg (mm)", ("peak of Kraft (kN) of 25 kN", "9.1 kN")),
        ("Carga máxima: 25.0 kN\nTiempo (s),Carga (kN),Desplazamiento (mm)", ("25 kN", "9.1 kN")),
        ("Höchstkraft: 25.0 kN\nZeit (s),Kraft (kN),Weg (mm)", ("25 kN", "9.1 kN")),
        ("Start Time,12:00:00.000\nEnd Time,12:00:10.000\nTime (s),Force (kN),Disp (mm)", ("10 s", "1.6 s")),
        ("サンプリング周波数,500,Hz\n時間(s),荷重(kN),変位(mm)", ("0.002 s", "0.004 s")),
        ("Örnekleme frekansı: 500 Hz\nZaman (s),Kuvvet (kN),Yer değiştirme (mm)", ("0.002 s", "0.004 s")),
    ],
)
def test_measurements_with_a_contradicting_header_are_refused(header: str, words: tuple[str, ...]) -> None:
    with pytest.raises(FileError) as caught:
        measured(table(header))
    assert all(word in str(caught.value) for word in words), str(caught.value)


@pytest.mark.parametrize(
    "header",
    [
        "Start Time,12:00:00\nEnd Time,12:00:02\nTime (s),Force (kN),Disp (mm)",
        "Load cell: 100 kN\nTime (s),Force (kN),Disp (mm)",
        "Carga máxima: 9.1 kN\nTiempo (s),Carga (kN),Desplazamiento (mm)",
        "Acc (N) note\nTime (s),Force (kN),Disp (mm)",
    ],
)
def test_measurements_with_a_header_that_agrees_are_read(header: str) -> None:
    assert [one.unit for one in measured(table(header)).columns] == ["s", "kN", "mm"]


def test_a_factor_in_the_header_of_measurements_is_named() -> None:
    found = measured(table("# Scale factor: 2.5\nTime (s),Force (kN),Disp (mm)"))
    assert "line 1 states 'scale factor: 2.5': not applied" in found.notes


def test_a_stated_peak_does_not_confirm_an_acceleration_beyond_any_record() -> None:
    with pytest.raises(MotionError, match=r"outside 0\.001 to 5 g"):
        motion("# units: g, dt = 0.01\n# PGA: 182.0 g")


def test_dt_before_npts_is_plain_text_and_no_damaged_at2() -> None:
    found = motion("Acceleration (cm/sec/sec) DT= .01 SEC NPTS= 400")
    assert (found.dt, np.max(np.abs(found.acceleration))) == pytest.approx((0.01, 1.82))


def test_a_count_below_the_samples_is_called_one() -> None:
    with pytest.raises(MotionError, match="stands below the samples"):
        ground_motions.read(record("# units: cm/s2, dt=0.01") + b"400\n", "made.txt")


@pytest.mark.parametrize(
    ("encoding", "header"),
    [
        ("cp932", "観測点: 仙台\n単位: gal\nサンプリング周波数: 100 Hz\nデータ数: {}\n最大加速度: 182.0 gal"),
        ("euc_jp", "観測点: 仙台\n単位: gal\nサンプリング周波数: 100 Hz\nデータ数: {}\n最大加速度: 182.0 gal"),
        ("gb18030", "台站: 汶川\n单位: cm/s2\n采样频率: 100 Hz\n数据点数: {}\n最大值: 182.0"),
        ("cp1254", "İstasyon: Düzce\nBirim: cm/s2\nÖrnekleme aralığı (s): 0.01\nVeri sayısı: {}\nEn büyük ivme: 182.0"),
    ],
)
def test_a_header_in_a_code_page_of_its_language_is_read(encoding: str, header: str) -> None:
    found = ground_motions.read(record(header.format(400)).decode().encode(encoding), "made.txt")
    assert (found.dt, np.max(np.abs(found.acceleration))) == pytest.approx((0.01, 1.82))
    with pytest.raises(MotionError, match="500; the data have 400"):
        ground_motions.contents(record(header.format(500)).decode().encode(encoding), "made.txt")


def test_names_in_a_japanese_code_page_are_not_garbled_and_latin_1_stays() -> None:
    japanese = measured(table("時間(s),荷重(kN),変位(mm)").decode().encode("cp932"))
    assert [one.name for one in japanese.columns] == ["時間(s)", "荷重(kN)", "変位(mm)"]
    german = measured(table("Zeit (s),Kraft (kN),Verschiebung größer (mm)").decode().encode("latin-1"))
    assert german.columns[2].name == "Verschiebung größer (mm)"


@pytest.mark.parametrize(
    ("line", "unit", "scale"),
    [
        ("# Force gain: 2.5 kN/V", "V", 2.5),
        ("# Force sensitivity: 400 mV/kN", "V", 2.5),
        ("# Force: scale factor 2.5 kN/count", "counts", 2.5),
        ("# Calibration of Force 2.5 kN per V", "V", 2.5),
    ],
)
def test_the_gain_of_a_named_column_is_applied(line: str, unit: str, scale: float) -> None:
    found = measured(table(f"{line}\nTime (s),Force ({unit}),Disp (mm)")).columns[1]
    plain = measured(table(f"Time (s),Force ({unit}),Disp (mm)")).columns[1]
    assert (found.name, found.unit) == ("Force", "kN")
    assert "line 1" in found.applied
    np.testing.assert_allclose(found.values, scale * plain.values)


@pytest.mark.parametrize(
    "header",
    [
        "# Gain: 2.5 kN/V\nTime (s),Force (V),Disp (mm)",
        "# Force gain: 2.5 kN/V, offset 0.1 V\nTime (s),Force (V),Disp (mm)",
        "# Force gain: 2.5 kN/V\nTime (s),Force (kN),Disp (mm)",
        "# Force gain: 2.5 kN/V\n# Force gain: 3 kN/V\nTime (s),Force (V),Disp (mm)",
    ],
)
def test_a_gain_that_may_not_be_the_columns_is_left_to_the_mapping(header: str) -> None:
    found = measured(table(header)).columns[1]
    assert not found.applied
    assert found.name.startswith("Force (")
