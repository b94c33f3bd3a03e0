"""A record as a file of the library: one .npz with the samples and a description that can be read without the samples."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions.record import Motion

SUFFIX = ".npz"
_SCHEMA = "rths-motion/1"
_TEXTS = ("title", "provenance", "event", "component", "station")
_DAMAGE = (OSError, EOFError, KeyError, TypeError, ValueError, zipfile.BadZipFile, zlib.error)


def save(folder: Path, motion: Motion) -> None:
    """Write `motion` to `folder` completely or not at all. Raises FileExistsError when its name is in use."""
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{motion.name}{SUFFIX}"
    with files.temporary(target) as written:
        with written.open("wb") as file:
            np.savez_compressed(file, meta=np.array(json.dumps(_description(motion))), acceleration=motion.acceleration)
        files.sync(written)
        os.link(written, target)  # unlike a rename, this fails when the name is in use
        files.sync(folder)


def load(path: Path) -> Motion:
    """The record in `path`. Raises MotionError when the file is damaged."""
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            about = _about(file)
            texts = {key: str(about[key]) for key in _TEXTS}
            motion = Motion(name=path.stem, dt=float(about["dt"]), acceleration=file["acceleration"], **texts)
    except (*_DAMAGE, MotionError) as error:
        raise _damaged(path, error) from None
    if motion.sha256 != about["sha256"]:
        raise _damaged(path, "its checksum differs from the stored checksum")
    return motion


def describe(path: Path) -> dict[str, Any]:
    """Title, origin, step, duration and so on, read without the samples. Raises MotionError when the file is damaged."""
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            return _about(file)
    except _DAMAGE as error:
        raise _damaged(path, error) from None


def _description(motion: Motion) -> dict[str, Any]:
    numbers = {"dt": motion.dt, "samples": len(motion.acceleration), "duration": motion.duration, "pga": motion.pga}
    texts = {key: getattr(motion, key) for key in _TEXTS}
    return {"schema": _SCHEMA, **texts, **numbers, "sha256": motion.sha256}


def _about(file: Any) -> dict[str, Any]:
    about: dict[str, Any] = json.loads(str(file["meta"]))
    if about["schema"] != _SCHEMA:
        raise ValueError(f"its format is {about['schema']}, not {_SCHEMA}")
    return about


def _damaged(path: Path, reason: object) -> MotionError:
    problem = f"the stored record is damaged: {reason}"
    return MotionError(Issue("record", problem, path.stem, "remove it and upload the record again"))
