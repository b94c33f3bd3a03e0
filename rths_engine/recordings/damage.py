"""The errors that a damaged or altered recording causes where it is read; readers make a RecordingError of them."""

from __future__ import annotations

KINDS: tuple[type[Exception], ...] = (
    OSError,
    LookupError,
    TypeError,
    ValueError,
    AttributeError,  # a group in the place of a dataset, a number in the place of an object
    RuntimeError,  # of the HDF5 library; with it RecursionError, of deeply nested JSON
    MemoryError,  # a stated size that no machine has
)
