"""The order for one shard of a sweep, and its results. Imports nothing heavy, because the sweep process loads it too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from app.config import Settings
from app.jobs.order import Order


@dataclass(frozen=True, slots=True)
class ShardOrder(Order):
    """One attempt at a shard: the sweep with its definition and columns, and the spans (first, end) of points to execute."""

    sweep_id: str
    definition: dict[str, Any]
    columns: tuple[dict[str, Any], ...]
    spans: tuple[tuple[int, int], ...]
    settings: Settings


@dataclass(frozen=True, slots=True)
class ShardPart:
    """Results of consecutive points: the first (from 0), rows of little-endian float64, and the counts and sums of the rows."""

    first: int
    count: int
    values: bytes
    reasons: dict[str, str]
    tripped: int
    invalid: int
    failed: int
    elapsed_s: float
    simulated_s: float


@dataclass(frozen=True, slots=True)
class ShardEnd:
    """The end of an attempt; its results were sent as parts."""

    cancelled: bool
