"""Fifty files of one rig: a sine test of a damper at growing amplitudes, and a few files that differ."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping as Texts
from typing import Any

import numpy as np

RATE = 100.0  # Hz
ROWS = 200
T = np.arange(ROWS) / RATE
HEADS = ("Time (s)", "Disp (mm)", "Force (kN)")
DIFFERENT = {
    "run11.csv": "unit",
    "run17.csv": "missing",
    "run23.csv": "rate",
    "run31.csv": "damaged",
    "run37.csv": "order",
    "run41.csv": "large",
    "run43.csv": "constant",
    "run47.csv": "copy",
}


def name(number: int) -> str:
    return f"run{number:02d}.csv"


def signals(number: int) -> dict[str, np.ndarray]:
    """Time (s), displacement (mm) and force (kN) of a run."""
    x = (1 + 0.1 * number) * np.sin(2 * np.pi * 0.5 * T)
    return {"Time (s)": T, "Disp (mm)": x, "Force (kN)": 0.4 * x + 0.01 * number}


def csv(columns: Texts[str, Any]) -> bytes:
    rows = np.column_stack(list(columns.values()))
    text = io.StringIO()
    np.savetxt(text, rows, "%.9g", ",", header=",".join(columns), comments="")
    return text.getvalue().encode()


def file(number: int) -> bytes:
    """The file of a run; that of `DIFFERENT` differs from the others as it says there."""
    of, kind = signals(number), DIFFERENT.get(name(number), "")
    if kind == "unit":
        of = {"Time (s)": T, "Disp (mm)": of["Disp (mm)"], "Force (N)": 1e3 * of["Force (kN)"]}
    elif kind == "missing":
        del of["Force (kN)"]
    elif kind == "rate":
        of["Time (s)"] = 2 * T
    elif kind == "order":
        of = {head: of[head] for head in ("Time (s)", "Force (kN)", "Disp (mm)")}
    elif kind == "large":
        of["Force (kN)"] = 1e3 * of["Force (kN)"]
    elif kind == "constant":
        of["Force (kN)"] = np.ones(ROWS)
    elif kind == "copy":
        return file(2)
    raw = csv(of)
    return raw.replace(b"\n0.9,", b"\ncable loose\n0.9,") if kind == "damaged" else raw


def fifty() -> dict[str, bytes]:
    return {name(number): file(number) for number in range(50)}


def mapping(by_number: bool = False, **more: Any) -> dict[str, Any]:
    """The mapping of the fifty files, by names or by numbers of columns."""
    roles = zip(HEADS, ("t", "x_meas", "f_meas"), ("s", "mm", "kN"), strict=True)
    channels = [
        {"column": number if by_number else head, "role": role, "unit": unit}
        for number, (head, role, unit) in enumerate(roles, 1)
    ]
    return {"channels": channels, **more}


def zipped(files: Texts[str, bytes]) -> bytes:
    raw = io.BytesIO()
    with zipfile.ZipFile(raw, "w", zipfile.ZIP_DEFLATED) as archive:
        for one, content in files.items():
            archive.writestr(one, content)
    return raw.getvalue()
