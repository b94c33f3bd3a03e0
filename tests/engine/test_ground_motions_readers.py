"""Readers of AT2, COSMOS and CSMIP V2 and plain columns: one short record written in each form, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import MotionError
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import channels, read

DT = 0.01
SHAPE = 0.3 * np.sin(np.arange(123) * 0.4) * np.exp(-np.arange(123) / 60)  # g
SI = SHAPE * STANDARD_GRAVITY


def rows(values: np.ndarray, per_line: int, form: str) -> str:
    lines = [values[i : i + per_line] for i in range(0, len(values), per_line)]
    return "\n".join("".join(form % number for number in line) for line in lines)


def at2(counts: str = "NPTS=    123, DT=   .0100 SEC", values: np.ndarray = SHAPE) -> str:
    header = "PEER NGA STRONG MOTION DATABASE RECORD\nNorthridge-01, 1/17/1994, Canyon Country - W Lost Cany, 0"
    return f"{header}\nACCELERATION TIME SERIES IN UNITS OF G\n{counts}\n{rows(values, 5, '%15.7E')}\n"


def csmip(*scales: float) -> str:
    text = ""
    for number, scale in enumerate(scales, start=1):
        acceleration = rows(SI * 100 * scale, 8, "%10.3f")
        text += (
            "Corrected accelerogram data\nNorthridge Earthquake  January 17, 1994\n"
            f"Station No. 24278\nChan  {number}: {90 * number} Deg  \n"
            f"    123 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.3)\n{acceleration}\n"
            f"    123 points of veloc data equally spaced at  .010 sec, in cm/sec. (8f10.3)\n{acceleration}\n"
            f"/&  ----------  End of data for channel  {number}  ----------\n"
        )
    return text


def cosmos(form: str = "(8f10.5)", dt: str = f"{DT * 1000:10.5f}") -> str:
    reals = [f"{-999:10.1f}"] * 61 + [dt] + [f"{-999:10.1f}"] * 38
    per_line, width, digits = {"(8f10.5)": (8, 10, 5), "(10F8.3)": (10, 8, 3), "(1E15.6)": (1, 15, 6)}[form]
    letter = "E" if "E" in form else "f"
    block = rows(SI * 100, per_line, f"%{width}.{digits}{letter}")
    header = "\n".join("".join(reals[i : i + 8]) for i in range(0, 100, 8))
    return (
        "Corrected acceleration data   (Format v01.20 with 14 text lines)\nNapa earthquake of Sun Aug 24, 2014\n"
        "Statn No: 02-    0  Code:NP-1743   USGS CA:Petaluma;FS 2\nSta Chan   1: 90 deg (Rcrdr Chan  1) Location:\n"
        f" 100 Real-header values follow on  13 lines, Format= (8F10.1)\n{header}\n"
        '   1 Comment line(s) follow, each starting with a "|":\n| no comment\n'
        f"     123 acceleration pts, approx   1 secs, units=cm/sec2(04),Format={form}\n{block}\n"
        "End-of-data for Chan  1 acceleration\n"
    )


def columns(separator: str, header: str = "", comma: bool = False, time: bool = True) -> str:
    lines = [f"{i * DT:.3f}{separator}{a:.7f}" if time else f"{a:.7f}" for i, a in enumerate(SHAPE)]
    text = "\n".join(lines)
    return header + (text.replace(".", ",") if comma else text) + "\n"


def raises(text: str | bytes, *words: str, name: str = "file.txt", **more: Any) -> MotionError:
    raw = text if isinstance(text, bytes) else text.encode()
    with pytest.raises(MotionError) as caught:
        read(raw, name, **more)
    for word in words:
        assert word in str(caught.value), str(caught.value)
    return caught.value


@pytest.mark.parametrize(
    "counts", ["NPTS=    123, DT=   .0100 SEC,", "NPTS=123, DT=0.01", "  123   0.0100   NPTS, DT", "npts = 123  dt = 1.0E-02"]
)
def test_at2_is_read_with_old_and_new_headers(counts: str) -> None:
    motion = read(at2(counts).encode(), "RSN960_LOS000.AT2")
    np.testing.assert_allclose(motion.acceleration, SI, atol=1e-7 * STANDARD_GRAVITY)  # written with 8 digits
    assert (motion.dt, motion.name, motion.component) == (DT, "rsn960-los000", "0")
    assert (motion.event, motion.station) == ("Northridge-01, 1/17/1994", "Canyon Country - W Lost Cany")


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.encode("utf-8-sig"),
        lambda text: text.replace("\n", "\r\n").encode(),
        lambda text: text.replace("Northridge-01", "Séisme d'été").encode("latin-1"),
        lambda text: text.replace("E-0", "D-0").encode(),
        lambda text: text.encode() + b"\x1a",
        lambda text: text.replace(" -", "-").encode(),
    ],
    ids=["byte order mark", "CRLF", "Latin-1", "Fortran D exponent", "DOS end of file", "numbers that touch"],
)
def test_at2_is_read_in_every_way_files_come(change: Callable[[str], bytes]) -> None:
    motion = read(change(at2()), "any name")
    np.testing.assert_allclose(motion.acceleration, SI, atol=1e-7 * STANDARD_GRAVITY)


def test_the_content_decides_about_the_format_not_the_name() -> None:
    assert "AT2" in read(at2().encode(), "x.csv").provenance
    assert "columns" in read(columns("\t", "t\ta (g)\n").encode(), "x.at2").provenance
    assert "V2" in read(csmip(1.0).encode(), "x.txt").provenance


def test_csmip_v2_gives_each_channel_by_its_number() -> None:
    raw = csmip(1.0, 0.5, 2.0).encode()
    first, third = read(raw, "a.v2", channel=1), read(raw, "a.v2", channel=3)
    np.testing.assert_allclose(first.acceleration, SI, atol=0.51e-5)  # written to 0.001 cm/s^2
    np.testing.assert_allclose(third.acceleration, 2 * SI, atol=0.51e-5)
    assert (first.dt, first.component, third.component) == (DT, "24278 90 deg", "24278 270 deg")
    assert channels(raw, "a.v2") == ("24278 90 deg", "24278 180 deg", "24278 270 deg")
    raises(raw, "channel = 4", "3 channels", "2: 24278 180 deg", channel=4)


@pytest.mark.parametrize(("form", "written_to"), [("(8f10.5)", 1e-5), ("(10F8.3)", 1e-3), ("(1E15.6)", 1e-4)])
def test_cosmos_v2_takes_step_unit_and_columns_from_its_headers(form: str, written_to: float) -> None:
    motion = read(cosmos(form).encode(), "CE47380.V2")
    np.testing.assert_allclose(motion.acceleration, SI, atol=0.51e-2 * written_to)
    assert (motion.dt, motion.component, motion.station) == (DT, "NP-1743 90 deg", "Petaluma;FS 2")


def test_cosmos_v2_without_a_step_asks_for_it() -> None:
    raises(cosmos(dt=f"{-999:10.1f}"), "dt:", "give the step")
    assert read(cosmos(dt=f"{-999:10.1f}").encode(), "a.v2", dt=0.02).dt == 0.02


@pytest.mark.parametrize("separator", ["\t", ";", ",", " ", "   ", ", "])
def test_time_and_acceleration_are_read_with_any_separator(separator: str) -> None:
    motion = read(columns(separator).encode(), "a.txt", unit="g")
    np.testing.assert_allclose(motion.acceleration, SI, atol=0.51e-7 * STANDARD_GRAVITY)
    assert motion.dt == DT


@pytest.mark.parametrize("separator", ["\t", ";", " "])
def test_a_decimal_comma_is_read_where_nothing_else_can_be_meant(separator: str) -> None:
    motion = read(columns(separator, comma=True).encode(), "a.csv", unit="g")
    np.testing.assert_allclose(motion.acceleration, SI, atol=0.51e-7 * STANDARD_GRAVITY)


@pytest.mark.parametrize("text", [columns(",", comma=True), columns("", comma=True, time=False)])
def test_a_comma_that_may_be_decimal_or_separator_is_refused(text: str) -> None:
    raises(text, "line 1", "comma", "decimal point", unit="g", dt=DT)


def test_comma_and_point_together_are_refused_where_columns_have_another_separator() -> None:
    raises(columns("\t").replace("0.010\t", "0,010\t"), "line 2", "both comma and point", unit="g")


@pytest.mark.parametrize("per_line", [1, 5, 8])
def test_acceleration_alone_is_read_with_one_or_several_values_a_line(per_line: int) -> None:
    motion = read(rows(SI, per_line, "%14.6E").encode(), "a.txt", unit="m/s^2", dt=0.005)
    np.testing.assert_allclose(motion.acceleration, SI, atol=1e-6)
    assert motion.dt == 0.005


def test_a_time_column_before_several_channels_gives_the_chosen_one() -> None:
    text = "\n".join(f"{i * DT:.2f} {a:.7f} {2 * a:.7f}" for i, a in enumerate(SHAPE))
    second = read(text.encode(), "a.txt", unit="g", channel=2)
    np.testing.assert_allclose(second.acceleration, 2 * SI, atol=1e-6)
    raises(text, "channel = 3", "2 channels", unit="g", channel=3)


@pytest.mark.parametrize(
    "header",
    [
        "# dt = 0.01 s, units: g\n",
        "% Acceleration in g\n% time step 10 ms\n",
        "Acceleration [g]\nsampling rate: 100 Hz\n",
        '"dt: .01"\n"a (g)"\n',
    ],
)
def test_step_and_unit_are_taken_from_header_and_comment_lines(header: str) -> None:
    motion = read(columns("", header, time=False).encode(), "a.txt")
    np.testing.assert_allclose(motion.acceleration, SI, atol=1e-6)
    assert motion.dt == pytest.approx(DT, rel=1e-12)


def test_a_first_line_of_count_and_step_is_a_header() -> None:
    motion = read(f"123 0.01\n{columns('', time=False)}".encode(), "a.txt", unit="g")
    assert (len(motion.acceleration), motion.dt) == (123, DT)


@pytest.mark.parametrize("written", ["cm/s^2", "cm/s2", "cm/sec/sec", "cm/sec²", "Gal"])
def test_units_are_recognised_as_headers_write_them(written: str) -> None:
    motion = read(f"# {written}\n{rows(SI * 100, 1, '%.5f')}".encode(), "a.txt", dt=DT)
    np.testing.assert_allclose(motion.acceleration, SI, atol=1e-6)


def test_a_given_unit_or_step_that_differs_from_the_files_is_refused() -> None:
    raises(at2(), "unit = m/s^2", "the file states g", unit="m/s^2")
    raises(at2(), "dt = 0.02", "the file says 0.01 s", dt=0.02)
    assert read(csmip(1.0).encode(), "a.v2", unit="gal", dt=DT).pga == pytest.approx(np.max(np.abs(SI)), rel=1e-4)  # as cm/s^2


@pytest.mark.parametrize("scale", [1e-4, 50.0])
def test_a_small_peak_is_read_where_the_format_states_its_unit_and_one_beyond_any_record_is_refused(scale: float) -> None:
    peak = np.argmax(np.abs(SHAPE))
    stated = f"Peak acceleration = {SI[peak] * 100 * scale:.3f} cm/sec/sec at {peak * DT:.3f} sec.\nStation No."
    raw = csmip(scale).replace("Station No.", stated).encode()
    if scale > 1:
        raises(raw, "outside 0.001 to 5 g")  # the stated peak has the unit of the samples and does not confirm it
        raises(csmip(scale), "outside 0.001 to 5 g")
    else:
        assert read(raw, "a.v2").pga == pytest.approx(np.max(np.abs(SI)) * scale, abs=0.51e-5)
        assert read(csmip(scale).encode(), "a.v2").pga > 0  # an aftershock in the unit of the format


def test_a_unit_that_is_no_acceleration_is_refused() -> None:
    raises(csmip(1.0).replace("in cm/sec2.", "in kN."), "unit = kN", "not a unit of acceleration")
    raw = cosmos().replace("units=cm/sec2(04)", "units=volts (51)")
    raises(raw, "unit = V", "not a unit of acceleration", unit="g")


def test_text_that_calls_itself_at2_is_refused_with_line_and_remedy() -> None:
    raises(
        "Dear colleague,\nhere is the record.\n",
        "line 1",
        "Dear colleague",
        "not an AT2 record",
        "NPTS= 4000",
        name="letter.AT2",
    )
    raises("<html><body>Login</body></html>", "not an AT2 record", name="RSN1.AT2")


def test_prose_is_refused_as_no_numbers() -> None:
    raises("Dear colleague,\nhere is the record.\n", "contains no numbers", "COSMOS V2", name="letter.txt")


def test_a_word_among_the_samples_is_named_with_its_line() -> None:
    lines = at2().splitlines()
    lines[8] = lines[8][:-3] + "xyz"
    raises("\n".join(lines), "line 9", "xyz", "is not a number")
    raises(columns(" ") + "end of record\n", "line 124", "is not a number", unit="g")


@pytest.mark.parametrize("count", [122, 124])
def test_at2_with_another_count_than_npts_is_refused(count: int) -> None:
    raises(at2(f"NPTS= {count}, DT= .01 SEC"), f"states a number of samples of {count}", "the data have 123", "line 4")


def test_at2_of_velocity_or_without_a_uniform_step_is_refused() -> None:
    raises(at2().replace("ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S"), "velocity")
    raises(at2("NPTS= 123, DT= UNEVEN"), "line 4", "UNEVEN", "uniform step")
    raises(at2("NPTS 123 DT .01"), "line 4", "known format")


def test_cut_blocks_are_refused() -> None:
    cut = csmip(1.0).replace("123 points of accel", "130 points of accel")
    raises(cut, "states a number of samples of 24278 90 deg acceleration of 130; the data have 123")


@pytest.mark.parametrize("bad", ["NaN", "inf", "-Infinity", "1e999"])
def test_a_number_that_is_not_finite_is_refused_with_its_place(bad: str) -> None:
    lines = columns("", time=False).splitlines()
    lines[10] = bad
    raises("\n".join(lines), "sample 11", "NaN or infinity", unit="g", dt=DT)


@pytest.mark.parametrize(
    ("dt", "words"),
    [(1e-4, "0.0005 to 0.1"), (0.2, "0.0005 to 0.1"), (0.0, "0.0005"), (-0.01, "0.0005"), (float("nan"), "0.0005")],
)
def test_a_step_outside_the_bounds_is_refused(dt: float, words: str) -> None:
    raises(columns("", time=False), "dt = ", words, unit="g", dt=dt)


def test_missing_unit_and_step_are_asked_for_together() -> None:
    issues = raises(columns("", time=False)).issues
    assert {issue.where for issue in issues} == {"unit", "dt"} and all(issue.fix for issue in issues)


def test_a_time_column_with_a_gap_or_going_back_is_refused_with_its_line() -> None:
    lines = columns(" ").splitlines()
    raises("\n".join(lines[:60] + lines[63:]), "line 61", "uniform step", unit="g")
    lines[70] = lines[20]
    raises("\n".join(lines), "line 71", "uniform step", unit="g")


def test_too_short_a_record_is_refused() -> None:
    raises("\n".join(columns("", time=False).splitlines()[:49]), "at least 50 samples", unit="g", dt=DT)


def test_a_record_in_cm_per_s2_given_as_g_is_told_apart() -> None:
    raises(rows(SI * 100, 1, "%.4f"), "looks like cm/s^2 given as g: choose the unit", unit="g", dt=DT)
    raises(rows(SHAPE, 1, "%.6f"), "looks like g given as cm/s^2", unit="cm/s^2", dt=DT)


def test_a_record_of_zeros_and_an_unknown_unit_or_format_are_refused() -> None:
    raises("0.0\n" * 100, "zero throughout", unit="g", dt=DT)
    raises(columns("", time=False), "unit = furlong", "cm/s^2", unit="furlong", dt=DT)
    raises(columns(""), "format = xyz", "choose one of", "at2", format="xyz")


@pytest.mark.parametrize("raw", [b"PK\x03\x04\x14\x00", b"\x1f\x8b\x08\x00abc", b"%PDF-1.7 text", bytes(range(256)) * 4])
def test_binary_content_is_refused(raw: bytes) -> None:
    raises(raw, "binary", "text")


def test_empty_files_are_refused_and_utf16_is_read_unless_it_is_damaged() -> None:
    raises(b"", "is empty")
    raises(b" \r\n\r\n", "is empty")
    assert read(at2().encode("utf-16"), "a.at2").dt == DT
    raises(at2().encode("utf-16")[:-1], "UTF-16", "damaged")


def test_any_cut_of_a_file_is_read_or_refused_and_never_crashes() -> None:
    for text in (at2(), csmip(1.0, 1.0), cosmos(), columns(",", "t,a (g)\n"), columns(" ", comma=True)):
        raw = text.encode()
        for cut in range(0, len(raw), 37):
            for part in (raw[:cut], raw[cut:]):
                try:
                    read(part, "a.at2", unit="g", dt=DT)
                except MotionError as error:
                    assert all(issue.problem for issue in error.issues)
