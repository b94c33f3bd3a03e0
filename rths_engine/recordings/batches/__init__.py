"""Many files of measurements by one mapping: each is imported or refused, with a table of what differs between them."""

from __future__ import annotations

from rths_engine.recordings.batches.archive import Archive, Limits
from rths_engine.recordings.batches.batch import Batch, Item, Row, run
from rths_engine.recordings.batches.difference import Difference

__all__ = ["Archive", "Batch", "Difference", "Item", "Limits", "Row", "run"]
