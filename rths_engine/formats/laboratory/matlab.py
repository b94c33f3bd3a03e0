"""MATLAB up to v7: variables, structs and their fields. v7.3 is HDF5."""

from __future__ import annotations

import io
import math
import warnings

import scipy.io

from rths_engine.formats import tree
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_HEAD = b"MATLAB 5.0 MAT-file"


def looks_like(source: Source) -> bool:
    """Whether the file is a MATLAB file, by its header or its name."""
    return source.head.startswith(_HEAD) or source.extension == "mat"


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    raw = source.bytes()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _, shape, _ in scipy.io.whosmat(io.BytesIO(raw)):
                refuse_many(math.prod(shape))
            variables = scipy.io.loadmat(io.BytesIO(raw), simplify_cells=True)
    except FileError:
        raise
    except Exception as error:
        problem = f"cannot be read as a MATLAB file: {type(error).__name__}"
        raise FileError(Issue("file", problem, fix="save it again with `save -v7` or as CSV")) from None
    return tree.table({name: value for name, value in variables.items() if not name.startswith("__")}, "MATLAB")


FORMAT = Format(
    key="matlab",
    title="MATLAB up to v7",
    of="measurement",
    extensions=("mat",),
    defined="MAT-File Format, MathWorks",
    header="units and time step of each struct",
    compared="",
    looks_like=looks_like,
    read=read,
    library="SciPy",
    apart=True,
)
