"""A score beside its published figure, and the two measures of error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array


@dataclass(frozen=True)
class Entry:
    """The error of one model on the tested data."""

    model: str
    error: float


@dataclass(frozen=True)
class Score:
    """The errors of our models and of the published models on a data set.

    `measure` and `unit` say what the errors are. `split` says which data are fitted and which are tested, in the publication;
    `used` says the same of our figures. `ranked` is true only where both are the same. `lacks` names the files of the published
    split that the folder does not have. `source` says where the data set is published.
    """

    name: str
    title: str
    measure: str
    unit: str
    split: str
    source: str
    published: tuple[Entry, ...]
    used: str = ""
    ours: tuple[Entry, ...] = ()
    ranked: bool = False
    lacks: tuple[str, ...] = ()

    def scored(self, ours: Sequence[Entry], used: str, lacks: Sequence[str] = ()) -> Score:
        """The score with our errors. It is ranked unless the folder lacks a part of the published split."""
        return replace(self, ours=tuple(ours), used=used, lacks=tuple(lacks), ranked=bool(ours) and not lacks)

    def ranking(self) -> list[Entry]:
        """All models with the smallest error first; empty where the split differs from the published split."""
        mine = [Entry(f"{one.model} (this program)", one.error) for one in self.ours]
        return sorted([*self.published, *mine], key=lambda one: one.error) if self.ranked else []

    def as_dict(self) -> dict[str, Any]:
        return asdict(self) | {"ranking": [asdict(one) for one in self.ranking()]}


def rms_error(measured: Array, simulated: Array) -> float:
    """sqrt(mean(e^2)), e = measured - simulated."""
    return float(np.sqrt(np.mean((measured - simulated) ** 2)))


def pooled_error(pairs: Sequence[tuple[Array, Array]]) -> float:
    """sqrt(sum(e^2) / sum(f^2)) over the samples of all pairs of measured f and simulated signal, e = measured - simulated."""
    off = sum(float(np.sum((measured - simulated) ** 2)) for measured, simulated in pairs)
    return float(np.sqrt(off / sum(float(np.sum(measured**2)) for measured, _ in pairs)))
