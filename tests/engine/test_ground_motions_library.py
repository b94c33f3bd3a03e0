"""Motions as values, the bundled records and the folder of stored ones."""

from __future__ import annotations

import json
import re
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from rths_engine.foundation.errors import MotionError
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import Motion, MotionLibrary

INDEX = json.loads((files("rths_engine.parts.ground_motions") / "data" / "records.json").read_text(encoding="utf-8"))
SINE = Motion("my-sine", "A sine", 0.01, np.sin(np.arange(200) * 0.1), provenance="made here", event="none")


@pytest.mark.parametrize("name", sorted(INDEX))
def test_a_bundled_record_has_the_published_peak_and_the_length_its_provenance_states(name: str) -> None:
    motion = MotionLibrary(None).get(name)
    # published to 3 decimals of g
    assert motion.pga / STANDARD_GRAVITY == pytest.approx(INDEX[name]["pga_g"], abs=6e-4)
    told = re.search(r"(\d+) samples at ([\d.]+) s", motion.provenance)
    assert told is not None
    count, dt = told.groups()
    assert (len(motion.acceleration), motion.dt) == (int(count), float(dt))
    assert "MIT licence" in motion.provenance and motion.event and motion.station and motion.component


def test_el_centro_and_two_northridge_components_are_bundled() -> None:
    names = MotionLibrary(None).names()
    assert "imperial-valley-1940-el-centro-ns" in names
    assert sum(name.startswith("northridge-1994-") for name in names) >= 2
    assert names == sorted(INDEX)


def test_a_motion_is_read_only_and_keeps_its_own_copy_of_the_samples() -> None:
    samples = np.ones(10)
    motion = Motion("a", "a", 0.01, samples)
    samples[0] = 5.0
    assert motion.acceleration[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        motion.acceleration[0] = 2.0


def test_the_checksum_follows_step_and_samples_and_nothing_else() -> None:
    other_words = Motion("b", "other", SINE.dt, SINE.acceleration)
    changed = SINE.acceleration.copy()
    changed[7] = np.nextafter(changed[7], 1)
    assert other_words.sha256 == SINE.sha256
    assert Motion("a", "a", 0.02, SINE.acceleration).sha256 != SINE.sha256
    assert Motion("a", "a", SINE.dt, changed).sha256 != SINE.sha256


def test_resampling_is_linear_between_samples_and_zero_after_the_end() -> None:
    ramp = Motion("ramp", "ramp", 0.1, np.array([0.0, 1.0, 2.0, 3.0]))
    finer = ramp.resampled(0.05, duration=0.5)
    np.testing.assert_allclose(finer.acceleration, [0, 0.5, 1, 1.5, 2, 2.5, 3, 0, 0, 0, 0], atol=1e-12)
    assert finer.duration == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("dt", "samples"), [(0.0, [1.0, 2.0]), (np.nan, [1.0, 2.0]), (0.01, [1.0]), (0.01, [1.0, np.nan]), (0.01, [[1.0]])]
)
def test_a_motion_without_step_samples_or_finite_numbers_is_refused(dt: float, samples: list[float]) -> None:
    with pytest.raises(MotionError):
        Motion("bad", "bad", dt, np.array(samples))


def test_a_stored_record_comes_back_bit_for_bit_and_is_listed(tmp_path: Path) -> None:
    library = MotionLibrary(tmp_path / "motions")
    library.add(SINE)
    back = MotionLibrary(tmp_path / "motions").get("my-sine")
    assert back.sha256 == SINE.sha256
    assert (back.title, back.provenance, back.event) == (SINE.title, SINE.provenance, SINE.event)
    listed = next(entry for entry in library.summaries() if entry.name == "my-sine")
    assert (listed.samples, listed.dt, listed.pga, listed.bundled) == (200, 0.01, SINE.pga, False)
    assert [path.name for path in (tmp_path / "motions").iterdir()] == ["my-sine.npz"]


def test_a_taken_name_is_refused_and_the_stored_record_stays(tmp_path: Path) -> None:
    library = MotionLibrary(tmp_path)
    library.add(SINE)
    with pytest.raises(MotionError, match="already"):
        library.add(Motion("my-sine", "Another", 0.01, np.ones(100)))
    with pytest.raises(MotionError, match="already"):
        library.add(Motion("kobe-1995-nishi-akashi-000", "Mine", 0.01, np.ones(100)))
    assert library.get("my-sine").sha256 == SINE.sha256
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("name", ["../escape", "a/b", "", "UPPER", "-edge", "a" * 81, ".hidden"])
def test_a_name_that_is_no_record_name_is_neither_stored_nor_found(tmp_path: Path, name: str) -> None:
    library = MotionLibrary(tmp_path / "inside")
    with pytest.raises(MotionError, match="lower-case"):
        library.add(Motion(name, "a", 0.01, np.ones(100)))
    for use in (library.get, library.remove):
        with pytest.raises(MotionError, match="no record has this name"):
            use(name)
    assert not list(tmp_path.iterdir())


def test_an_unknown_record_names_the_nearest_ones() -> None:
    with pytest.raises(MotionError, match=r"did you mean .*kobe-1995-nishi-akashi-000"):
        MotionLibrary(None).get("kobe-1995-nishi-akashi-090")


def test_a_bundled_record_cant_be_removed_and_a_stored_one_can(tmp_path: Path) -> None:
    library = MotionLibrary(tmp_path)
    library.add(SINE)
    with pytest.raises(MotionError, match="cannot be removed"):
        library.remove("kobe-1995-nishi-akashi-000")
    library.remove("my-sine")
    assert "my-sine" not in library.names()
    with pytest.raises(MotionError, match="no record"):
        library.remove("my-sine")


def test_a_library_without_folder_stores_nothing() -> None:
    with pytest.raises(MotionError, match="no folder"):
        MotionLibrary(None).add(SINE)


@pytest.mark.parametrize("damage", ["cut", "emptied", "text", "flipped"])
def test_a_damaged_file_is_an_error_when_used_and_the_list_still_works(tmp_path: Path, damage: str) -> None:
    library = MotionLibrary(tmp_path)
    library.add(SINE)
    path = tmp_path / "my-sine.npz"
    whole = path.read_bytes()
    at = whole.index(b"acceleration.npy") + 200  # inside the compressed samples
    damaged = {
        "cut": whole[: len(whole) // 2],
        "emptied": b"",
        "text": b"not a record",
        "flipped": whole[:at] + bytes([whole[at] ^ 0xFF]) + whole[at + 1 :],
    }
    path.write_bytes(damaged[damage])
    with pytest.raises(MotionError, match="damaged"):
        library.get("my-sine")
    assert len(library.summaries()) == len(INDEX) + 1
