"""Arrays in the form that Plotly reads from JSON."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

Samples = NDArray[np.floating[Any]]


def packed(values: Samples) -> dict[str, str]:
    """A typed array: base64 of little-endian float32."""
    return {"dtype": "f4", "bdata": base64.b64encode(np.asarray(values, dtype="<f4").tobytes()).decode("ascii")}


def unpacked(values: dict[str, str]) -> Samples:
    """The values of a packed array."""
    return np.frombuffer(base64.b64decode(values["bdata"]), dtype="<f4").astype(np.float64)
