"""A file whose columns lie on disk gives the recording that the same file gives in memory."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import h5py
import numpy as np
import pytest

from rths_engine.formats import numeric_block
from rths_engine.formats.scratch import Scratch, on_disk
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import Mapping, blocks, checks, clock, examine, guess, read, relations, save, store
from rths_engine.recordings.measured.blocks import extent

SAMPLES = 3000
MAPPING = Mapping.read(
    {
        "schema": "rths-mapping/1",
        "channels": [
            {"column": "t (s)", "role": "t", "unit": "s"},
            {"column": "command (mm)", "role": "x_cmd", "unit": "mm"},
            {"column": "displacement (mm)", "role": "x_meas", "unit": "mm", "offset": 0.25},
            {"column": "velocity (mm/s)", "role": "v_meas", "unit": "mm/s"},
            {"column": "force (kN)", "role": "f_meas", "unit": "kN", "reverse": True},
        ],
    }
)


def file(path: Path, missing: bool = False, jitter: float = 0.0) -> Path:
    rng = np.random.default_rng(7)
    t = np.arange(SAMPLES) / 256
    x = 20 * np.sin(2 * np.pi * t)
    columns = [t + jitter * rng.uniform(-1, 1, SAMPLES) / 256, x, x + 0.01 * rng.normal(size=SAMPLES)]
    columns += [40 * np.pi * np.cos(2 * np.pi * t), np.clip(-3 * x, -50, 50)]
    rows = [",".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True)]
    if missing:
        rows[700] = rows[700].rpartition(",")[0] + ",n/a"
    path.write_text("t (s),command (mm),displacement (mm),velocity (mm/s),force (kN)\n" + "\n".join(rows) + "\n")
    return path


@pytest.fixture
def large(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numeric_block, "IN_MEMORY", 1000)
    monkeypatch.setattr(numeric_block, "PIECE", 5000)
    monkeypatch.setattr(store, "PIECE", 700)


@pytest.mark.parametrize(("missing", "jitter"), [(False, 0.0), (True, 0.0), (False, 0.2)])
def test_the_recording_of_a_large_file_is_that_of_a_small_file(
    missing: bool, jitter: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = file(tmp_path / "test.csv", missing, jitter)
    small = examine(read(path, path.name), MAPPING)
    monkeypatch.setattr(numeric_block, "IN_MEMORY", 1000)
    monkeypatch.setattr(blocks.parts, "__defaults__", (512,))
    monkeypatch.setattr(relations, "SHORT", 512)
    table = read(path, path.name)
    assert all(on_disk(one.values) for one in table.columns)
    found = examine(table, MAPPING)
    assert found.findings == small.findings
    assert small.measured is not None and found.measured is not None
    assert all(on_disk(one.values) for one in found.measured.channels)
    assert (found.measured.dt, found.measured.start) == (small.measured.dt, small.measured.start)
    for one, other in zip(found.measured.channels, small.measured.channels, strict=True):
        assert one.values.tobytes() == other.values.tobytes()


@pytest.mark.usefixtures("large")
def test_a_large_recording_is_stored_in_one_piece_and_loaded_as_it_was(tmp_path: Path) -> None:
    path = file(tmp_path / "test.csv")
    measured = examine(read(path, path.name), MAPPING).measured
    assert measured is not None
    save(tmp_path / "rec.h5", measured, durable=False)
    loaded = store.load(tmp_path / "rec.h5")
    with h5py.File(tmp_path / "rec.h5") as written:
        for one in loaded.channels:
            values = measured.get(one.role, one.number)
            assert written[one.key].chunks is None
            assert np.array_equal(written[one.key][:], values)
            assert on_disk(one.values) and np.array_equal(one.values, values)


@pytest.mark.usefixtures("large")
def test_a_large_file_is_guessed_from_its_middle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(import_module("rths_engine.recordings.measured.guess"), "EXCERPT", 512)
    path = file(tmp_path / "test.csv")
    roles = [channel.role for channel in guess(read(path, path.name)).mapping.channels]
    assert roles == ["t", "x_cmd", "x_meas", "v_meas", "f_meas"]


@pytest.mark.parametrize("values", [[1.0, 3.0, 3.0, -2.0, 3.0, -2.0], [0.0] * 6, [1.0, np.nan, 3.0, 4.0, 5.0, 6.0]])
def test_the_extent_of_blocks_is_that_of_the_whole(values: list[float], monkeypatch: pytest.MonkeyPatch) -> None:
    whole = np.array(values)
    monkeypatch.setattr(blocks.parts, "__defaults__", (2,))
    found = extent(whole)
    assert found.finite == np.isfinite(whole).all()
    if found.finite:
        wanted = whole.min(), whole.max(), (whole == whole.min()).sum(), (whole == whole.max()).sum()
        assert found == wanted


def kept(values: Array) -> Array:
    with Scratch(1, len(values)) as scratch:
        scratch.write(0, 0, values)
        return scratch.columns(len(values))[0]


@pytest.mark.parametrize("step", [1 / 1024, 0.01, 1 / 300, 0.0123456789])
def test_even_stamps_on_disk_have_the_clock_of_stamps_in_memory(step: float) -> None:
    times = np.round(5 + np.arange(70_000) * step, 6)
    (memory, found), (disk, also) = clock.of_stamps(times, "t"), clock.of_stamps(kept(times), "t")
    assert memory is not None and disk is not None
    assert found == also == []
    assert memory.uniform and disk.uniform
    assert disk.step == pytest.approx(memory.step, rel=1e-12)


def test_clipping_is_found_in_a_channel_on_disk() -> None:
    t = np.arange(4000) / 200
    noise = 1e-4 * np.random.default_rng(2).normal(size=len(t))
    values = kept(np.clip(np.sin(2 * np.pi * t) + noise, -0.9, 0.9))
    found = checks.shape(values, extent(values), t, "x", "m")
    assert [one.severity for one in found] == ["warning", "warning"]
