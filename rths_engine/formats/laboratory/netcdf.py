"""NetCDF 3 and NetCDF 4 (HDF5): every numeric variable, by the conventions CF."""

from __future__ import annotations

import io
import warnings
from typing import Any

import h5py
import numpy as np
from scipy.io import netcdf_file

from rths_engine.formats import damage
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import cf
from rths_engine.formats.laboratory.cf import Variable
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, refuse_many

_CLASSIC = (b"CDF\x01", b"CDF\x02")
_HDF5 = b"\x89HDF\r\n\x1a\n"
_MARKS = (b"_NCProperties", b"_Netcdf4Dimid", b"_nc3_strict")
_HIDDEN = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates", "_NCProperties"}


def looks_like(source: Source) -> bool:
    """Whether the content is NetCDF 3, or HDF5 with the marks of NetCDF 4 or its extension."""
    if source.head.startswith((*_CLASSIC, b"CDF\x05")):
        return True
    marked = source.extension in ("nc", "nc4") or any(mark in source.head for mark in _MARKS)
    return source.head.startswith(_HDF5) and marked


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    raw = source.bytes()
    with damage.refused("NetCDF"):
        return _classic(raw) if raw.startswith(b"CDF") else _hdf5(raw)


def _classic(raw: bytes) -> Table:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with netcdf_file(io.BytesIO(raw), "r", mmap=False, maskandscale=False) as file:
            refuse_many(sum(int(np.prod(one.shape)) for one in file.variables.values()))
            found = [
                Variable(name, np.array(one.data), dict(one._attributes), tuple(one.dimensions))
                for name, one in file.variables.items()
            ]
            about = _texts(dict(file._attributes))
    return cf.table(found, "NetCDF 3", about)


def _hdf5(raw: bytes) -> Table:
    with h5py.File(io.BytesIO(raw), "r") as file:
        found: list[Variable] = []
        _collect(file, "", found)
        return cf.table(found, "NetCDF 4", _texts(dict(file.attrs)))


def _collect(group: h5py.Group, path: str, found: list[Variable]) -> None:
    for name in group:
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            continue
        item = group[name]
        own = f"{path}/{name}".strip("/")
        if isinstance(item, h5py.Group):
            _collect(item, own, found)
        elif not item.is_virtual and not item.external and item.shape is not None and not _is_dimension_only(item):
            refuse_many(item.size)
            attributes = {key: value for key, value in item.attrs.items() if key not in _HIDDEN}
            if item.dtype.kind in "fiub":
                found.append(Variable(own, item[()], attributes, _dimensions(item, own, path)))


def _is_dimension_only(item: h5py.Dataset) -> bool:
    """Whether the dataset only stands for a dimension without a variable of its own."""
    name = item.attrs.get("NAME", b"")
    return isinstance(name, bytes) and name.startswith(b"This is a netCDF dimension but not a netCDF variable")


def _dimensions(item: h5py.Dataset, own: str, path: str) -> tuple[str, ...]:
    """The dimensions by the scales that are attached, those of the variable itself where it is a coordinate."""
    if item.attrs.get("CLASS") == b"DIMENSION_SCALE" and item.ndim == 1:
        return (own,)
    attached = [str(one[0].name).strip("/") if len(one) else "" for one in item.dims]
    return tuple(name or f"{path}/dimension of {length}".strip("/") for name, length in zip(attached, item.shape, strict=True))


def _texts(attributes: dict[str, Any]) -> dict[str, str]:
    texts = {key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for key, value in attributes.items()}
    return {key: value for key, value in texts.items() if isinstance(value, str) and key not in _HIDDEN and value}


FORMAT = Format(
    key="netcdf",
    title="NetCDF 3 and 4",
    of="measurement",
    extensions=("nc", "nc4", "cdf"),
    defined="NetCDF Classic Format and NetCDF-4, Unidata; CF Metadata Conventions 1.11",
    header="units, times since a date, scale_factor, add_offset, _FillValue, missing_value, valid range",
    compared="actual_range",
    looks_like=looks_like,
    read=read,
    public=9,
    public_check="netCDF4 1.7",
    library="SciPy, h5py",
    apart=True,
)
