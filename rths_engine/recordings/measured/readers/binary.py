"""The binary formats. Their libraries can crash on a damaged file, so only `apart` calls them."""

from __future__ import annotations

from rths_engine.recordings.measured.readers import hdf5, matlab, parquet
from rths_engine.recordings.measured.table import Table


def looks_like(raw: bytes, filename: str) -> bool:
    """Whether the file is Parquet, HDF5 or MATLAB."""
    return parquet.looks_like(raw) or hdf5.looks_like(raw) or matlab.looks_like(raw, filename)


def read(raw: bytes) -> Table:
    """Read a Parquet, HDF5 or MATLAB file."""
    if parquet.looks_like(raw):
        return parquet.read(raw)
    return hdf5.read(raw) if hdf5.looks_like(raw) else matlab.read(raw)
