"""MATLAB up to v7: variables, structs and their fields. v7.3 is HDF5."""

from __future__ import annotations

import io
import math
import warnings

import scipy.io

from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured.readers import tree
from rths_engine.recordings.measured.table import Table, refuse_many

_HEAD = b"MATLAB 5.0 MAT-file"


def looks_like(raw: bytes, filename: str) -> bool:
    """Whether the file is a MATLAB file, by its header or its name."""
    return raw.startswith(_HEAD) or filename.lower().endswith(".mat")


def read(raw: bytes) -> Table:
    """Read the file. Raises MeasuredError for errors of any kind, which a damaged file can cause."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _, shape, _ in scipy.io.whosmat(io.BytesIO(raw)):
                refuse_many(math.prod(shape))
            variables = scipy.io.loadmat(io.BytesIO(raw), simplify_cells=True)
    except MeasuredError:
        raise
    except Exception as error:
        problem = f"cannot be read as a MATLAB file: {type(error).__name__}"
        raise MeasuredError(Issue("file", problem, fix="save it again with `save -v7` or as CSV")) from None
    return tree.table({name: value for name, value in variables.items() if not name.startswith("__")}, "MATLAB")
