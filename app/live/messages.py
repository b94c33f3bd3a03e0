"""JSON messages of the live protocol."""

from __future__ import annotations

from typing import Any

from rths_engine.results.channels import Channel


def schema(
    attempt: int, dt: float, bucket: int, total: int, channels: tuple[Channel, ...], open_ended: bool = False
) -> dict[str, Any]:
    """The layout of frames: substeps of `dt` (s), `bucket` substeps in each of `buckets` buckets, and the channels.

    `factor` is the SI value of one shown unit. `open_ended` says that the test may end long before its last bucket.
    """
    shown = [
        {"key": c.key, "role": c.role, "number": c.number, "label": c.label, "unit": c.shown_label, "factor": c.factor}
        for c in channels
    ]
    layout = {"attempt": attempt, "dt": dt, "bucket": bucket, "buckets": -(-total // bucket), "channels": shown}
    return {"type": "schema", **layout, **({"open_ended": True} if open_ended else {})}


def progress(
    state: str, simulated_s: float, elapsed_s: float, duration_s: float, measures: dict[str, Any] | None = None
) -> dict[str, Any]:
    """The progress of a run; `measures` are the measures so far, `RunningMeasures.shown()`."""
    message = {"type": "progress", "state": state, "simulated_s": simulated_s, "elapsed_s": elapsed_s, "duration_s": duration_s}
    return message | ({"measures": measures} if measures else {})
