"""The files of a case: the shown plan and recordings, and the sealed truth."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py
from ruamel.yaml import YAML

from tests.proof.generator.motion import Array

UNITS = {
    "x": "m",
    "v": "m/s",
    "f": "N",
    "current": "A",
    "temperature": "K",
    "ag": "m/s^2",
    "a": "m/s^2",
    "drive": "m",
    "force": "N",
}


def write_plan(path: Path, plan: dict[str, Any]) -> None:
    yaml = YAML(typ="safe")
    yaml.default_flow_style = None
    with path.open("w", encoding="utf-8") as file:
        yaml.dump(plan, file)


def write_recording(path: Path, test: str, dt: float, channels: dict[str, Array], start: float = 0.0) -> None:
    """Write a recording as `rths-measured/1` (docs/importing.md). Keys of channels: `x_meas.1`, `ag`, ..."""
    with h5py.File(path, "w") as file:
        for key, values in channels.items():
            role, _, number = key.partition(".")
            dataset = file.create_dataset(key, data=values, compression="gzip")
            unit = UNITS[role] if role in UNITS else UNITS[role.split("_")[0]]
            dataset.attrs.update(role=role, number=int(number or 0), unit=unit, label=key, column=key)
        empty = dict.fromkeys(("source", "source_sha256", "mapping"), "")
        file.attrs.update(schema="rths-measured/1", code_version="", dt=dt, start_s=start, test=test, title=path.stem, **empty)
        file.attrs["warnings"] = json.dumps([])


def write_arrays(path: Path, arrays: dict[str, Array]) -> None:
    with h5py.File(path, "w") as file:
        for key, values in arrays.items():
            file.create_dataset(key, data=values, compression="gzip")
