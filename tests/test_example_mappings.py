"""The example mappings import every file of their sets, where the recordings are present ($RTHS_RECORDINGS)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rths_engine.recordings.measured import Mapping, Measured, imported, read
from tests.conftest import RECORDINGS

EXAMPLES = Path(__file__).parent.parent / "examples"
FILES = {
    "brfd": ("*.json", 9),
    "emps": ("*.mat", 1),
    "shaking_table": ("*.csv", 10),
    "free_vibration": ("A1-*.txt", 6),
    "mr_damper": ("*.csv", 8),
}
# what the sets' descriptions say: keys, rates (Hz) and the largest |value| to be expected of any file, in SI
EXPECTED = {
    "brfd": ({"x_meas.1": 0.04, "v_meas.1": 0.2, "f_meas.1": 26e3}, {1024.0}),
    "emps": ({"x_meas.1": 0.25, "f_meas.1": 160.0}, {1000.0}),
    "shaking_table": ({"drive": 8.0, "x_meas.1": 0.05, "v_meas.1": 0.05}, {200.0}),
    "free_vibration": ({"x_floor.1": 0.026}, {100.0}),
    "mr_damper": ({"x_meas.1": 0.026, "v_meas.1": 0.11, "f_meas.1": 1100.0}, {50.0, 100.0}),
}


def example(name: str) -> Mapping:
    return Mapping.from_yaml((EXAMPLES / name / "map.yaml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", FILES)
def test_an_example_mapping_is_sound(name: str) -> None:
    mapping = example(name)
    assert mapping.test is not None and {one.key for one in mapping.measurements} == set(EXPECTED[name][0])


@pytest.mark.parametrize("name", FILES)
def test_an_example_mapping_imports_every_file_of_its_set_without_doubt(name: str) -> None:
    folder = RECORDINGS / name
    if not folder.is_dir():
        pytest.skip(f"no recordings at {folder}: set RTHS_RECORDINGS to the folder that holds them")
    pattern, count = FILES[name]
    files = sorted(folder.glob(pattern))
    files = [path for path in files if path.name != "test_info.csv"]
    assert len(files) == count
    limits, rates = EXPECTED[name]
    found: list[Measured] = [imported(read(path.read_bytes(), path.name), example(name), path.name) for path in files]
    assert {round(1 / one.dt, 9) for one in found} == rates
    for path, one in zip(files, found, strict=True):
        assert one.warnings == (), path.name
        for key, largest in limits.items():
            role, _, number = key.partition(".")
            assert np.max(np.abs(one.get(role, int(number or 1)))) <= largest, (path.name, key)
