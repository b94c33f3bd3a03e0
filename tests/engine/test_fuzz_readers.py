"""Damaged files are refused clearly or read as something valid; a longer run: `python -m tests.fuzz --only readers`."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from rths_engine.formats import registry
from rths_engine.formats.plain.refusals import touches
from rths_engine.formats.source import Source
from rths_engine.foundation.errors import FileError, MeasuredError, RecordingError
from rths_engine.recordings import opening
from rths_engine.recordings.measured.clock import of_stamps
from rths_engine.recordings.measured.resample import resampled
from rths_engine.recordings.run_file import load, save
from rths_engine.running.run import simulate
from tests.engine.plans import building, make, quiet
from tests.fuzz.readers import READERS, faults
from tests.fuzz.seeds import SEEDS

EXAMPLES = 12  # of each reader


def test_every_format_has_a_file_to_damage_and_it_is_read() -> None:
    assert SEEDS.keys() == registry.BY_KEY.keys(), "give a new format a file in tests/fuzz/seeds.py"
    for key, (name, written) in SEEDS.items():
        otherwise = registry.RECORD if key == "record" else registry.COLUMNS
        source = Source(name, content=written())
        assert registry.detected(source, otherwise).key == key
        assert registry.read(source, otherwise).columns


@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_refused_clearly_or_read_as_something_valid(name: str) -> None:
    found = list(faults(name, EXAMPLES, seed=1))
    assert found == [], "\n".join(found)


def _changed(key: str, old: str, new: str) -> Source:
    name, written = SEEDS[key]
    text = written().decode("cp1252")
    assert old in text
    return Source(name, content=text.replace(old, new, 1).encode("cp1252"))


def test_a_number_of_a_header_that_is_not_finite_is_refused_with_its_line() -> None:
    with pytest.raises(FileError, match=r"line \d+ = 1e999: is not a finite number"):
        registry.read(_changed("lvm", "Samples\t120", "Samples\t1e999"))


def test_a_date_beyond_all_calendars_is_no_date() -> None:
    assert registry.read(_changed("mts", "5/13/2024 10:49:14", "99999999999999999999/13/2024 10:49:14")).columns


def test_a_token_of_many_digits_is_refused_without_trying_all_ways_to_divide_it() -> None:
    assert touches("1.5-2.5") and touches("1.23.45") and not touches("9" * 5000 + "x")
    with pytest.raises(FileError, match="is not a number"):
        registry.read(_changed("at2", "-3.4360000E-03", "9" * 5000 + "x"), registry.RECORD)


def test_a_count_of_thousands_of_digits_is_no_count() -> None:
    with pytest.raises(FileError) as refused:
        registry.read(Source("record.txt", content=b"9" * 5000 + b"\n0.1\n0.2\n0.3\n"), registry.RECORD)
    assert "ValueError" not in str(refused.value)


def test_values_too_large_to_be_interpolated_are_refused_with_the_largest() -> None:
    times = np.cumsum(0.1 + 0.05 * np.sin(np.arange(40)))
    clock, _ = of_stamps(times, "Time")
    assert clock is not None
    with pytest.raises(MeasuredError, match=r"1e\+308: has values that are too large to be resampled"):
        resampled(1e308 * (-1.0) ** np.arange(40), clock, clock.start, 20, 0.1)


def test_a_recording_that_was_altered_is_refused_with_its_name(tmp_path: Path) -> None:
    path = tmp_path / "run.h5"
    for attribute, value in (("channels", "[" * 5000), ("dt", float("nan")), ("channels", "[]"), ("summary", "[1]")):
        save(path, simulate(make(building([1e5], [1e7]), quiet(0.05), 0.01)))
        with h5py.File(path, "r+") as file:
            file.attrs[attribute] = value
        with pytest.raises(RecordingError, match=r"run\.h5 is not a complete"):
            load(path)
    with h5py.File(path, "r+") as file:
        file.attrs["schema"] = np.ones((2, 2))
    with pytest.raises(RecordingError, match=r"run\.h5 is not a recording"):
        opening.load(path)
