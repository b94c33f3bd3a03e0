"""Files of measurements that tests write: a damper's sine test, known at every sample."""

from __future__ import annotations

import io
import json
from typing import Any

import h5py
import numpy as np
import scipy.io
from arro3.core import Array, DataType, Field, Schema, Table
from arro3.io import write_parquet

RATE = 200.0  # Hz
T = np.arange(1001) / RATE
X = 25.0 * np.sin(2 * np.pi * 0.8 * T)  # mm
V = 25.0 * 2 * np.pi * 0.8 * np.cos(2 * np.pi * 0.8 * T)  # mm/s
F = 0.4 * X + 0.1 * V  # kN
NAMES = ("Time (s)", "Disp (mm)", "Vel (mm/s)", "Force (kN)")
COLUMNS = np.column_stack([T, X, V, F])


def mapping(**more: Any) -> dict[str, Any]:
    """The mapping of the columns by their names."""
    roles = zip(NAMES, ("t", "x_meas", "v_meas", "f_meas"), ("s", "mm", "mm/s", "kN"), strict=True)
    return {"channels": [{"column": name, "role": role, "unit": unit} for name, role, unit in roles], **more}


def text(separator: str = ",", decimal: str = ".", head: tuple[str, ...] = (), columns: np.ndarray = COLUMNS) -> bytes:
    rows = [separator.join(f"{number:.9g}".replace(".", decimal) for number in row) for row in columns]
    return "\n".join([*head, *rows]).encode()


def csv(columns: np.ndarray = COLUMNS) -> bytes:
    return text(head=(",".join(NAMES),), columns=columns)


def json_nested() -> bytes:
    units = ("mm", "mm/s", "kN")
    signals = {"disp": X, "vel": V, "force": F}
    body = {name: {"data": one.tolist(), "units": unit} for (name, one), unit in zip(signals.items(), units, strict=True)}
    return json.dumps({"test": "sine", "dt": 1 / RATE, **body}).encode()


def json_matrix() -> bytes:
    return json.dumps(
        {
            "data": COLUMNS.tolist(),
            "sampling freq": RATE,
            "displacement units": "mm",
            "velocity units": "mm/s",
            "force units": "kN",
        }
    ).encode()


def json_records() -> bytes:
    return json.dumps([dict(zip(NAMES, row, strict=True)) for row in COLUMNS.tolist()]).encode()


def matlab5() -> bytes:
    file = io.BytesIO()
    scipy.io.savemat(file, {"t_s": T, "test": {"disp_mm": X, "vel_mm_s": V[:, None], "force_kN": F}, "note": "sine"})
    return file.getvalue()


def matlab73() -> bytes:
    file = io.BytesIO()
    with h5py.File(file, "w", userblock_size=512) as written:
        for name, values in (("t_s", T), ("disp_mm", X), ("vel_mm_s", V), ("force_kN", F)):
            written.create_dataset(name, data=values[None, :]).attrs["MATLAB_class"] = np.bytes_("double")
        note = written.create_dataset("note", data=np.frombuffer("sine".encode("utf-16-le"), np.uint16)[:, None])
        note.attrs["MATLAB_class"] = np.bytes_("char")
    return b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512, b"\0") + file.getvalue()[512:]


def hdf5() -> bytes:
    file = io.BytesIO()
    with h5py.File(file, "w") as written:
        written.attrs["fs"] = RATE
        for name, values, unit in (("disp", X, "mm"), ("vel", V, "mm/s"), ("force", F, "kN")):
            written.create_dataset(f"daq/{name}", data=values).attrs["units"] = unit
    return file.getvalue()


def parquet(columns: np.ndarray = COLUMNS) -> bytes:
    fields = [Field(name, DataType.float64()) for name in NAMES] + [Field("operator", DataType.utf8())]
    arrays = [Array(np.ascontiguousarray(column)) for column in columns.T]
    table = Table.from_arrays([*arrays, Array(["Ana"] * len(columns), DataType.utf8())], schema=Schema(fields))
    file = io.BytesIO()
    write_parquet(table, file, compression="snappy")
    return file.getvalue()
