"""Packed files that expand too much are refused by the sizes that they declare, before they are unpacked."""

from __future__ import annotations

import io
import zipfile

import h5py
import numpy as np
import pytest

from rths_engine.formats import expansion
from rths_engine.formats.laboratory import hdf5, matlab
from rths_engine.formats.plain import excel
from rths_engine.formats.source import Source
from rths_engine.foundation.errors import FileError


@pytest.fixture(autouse=True)
def _small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expansion, "ALWAYS", 100_000)
    monkeypatch.setattr(expansion, "MOST_RATIO", 3)
    monkeypatch.setattr(expansion, "MOST_NODES", 50)


def hdf5_file(samples: int, links: int = 0, circle: bool = False) -> Source:
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file.create_dataset("force", data=np.zeros(samples), compression="gzip", chunks=(samples,))
        for one in range(links):
            file[f"link{one}"] = file["force"]
        if circle:
            for one in range(3):
                file[f"round{one}"] = file["/"]
    return Source("a.h5", content=stream.getvalue())


def test_an_hdf5_file_is_refused_by_what_its_datasets_declare() -> None:
    assert len(hdf5.read(hdf5_file(5_000)).columns) == 1
    for file in (hdf5_file(50_000), hdf5_file(5_000, links=10)):
        with pytest.raises(FileError, match="expands to more than"):
            hdf5.read(file)
    with pytest.raises(FileError, match="groups and arrays"):
        hdf5.read(hdf5_file(10, circle=True))


def test_a_matlab_file_is_refused_by_what_its_variables_declare() -> None:
    import scipy.io

    stream = io.BytesIO()
    scipy.io.savemat(stream, {"force": np.zeros(300_000)}, do_compression=True)
    with pytest.raises(FileError, match="expands to more than"):
        matlab.read(Source("a.mat", content=stream.getvalue()))


def test_a_workbook_is_refused_by_what_its_parts_declare() -> None:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b" " * 400_000)
    with pytest.raises(FileError, match="expands to more than"):
        excel.read(Source("a.xlsx", content=stream.getvalue()))
