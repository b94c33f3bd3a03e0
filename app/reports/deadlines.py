"""The deadlines of a test in real time as a section of its report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.reports.document import Facts, Head, Section, Table, Text
from rths_engine.results import timing_text


def deadlines(timing: Mapping[str, Any] | None) -> list[Section]:
    """The section; none for a test that ran as fast as possible, or that an earlier version recorded."""
    if timing is None:
        return []
    counts = f"{timing_text.sentence(timing)} {timing_text.late(timing)}"
    said = [counts, timing_text.worst(timing), *timing_text.rights(timing)]
    heads = [Head("Quantity", share=2.2), *(Head(one, number=True) for one in timing_text.HEADS)]
    rows = [[label, *values] for label, values in timing_text.percentiles(timing)]
    buckets = [[label, str(delays), str(lengths)] for label, delays, lengths in timing_text.buckets(timing)]
    of_buckets = [Head("Time, µs"), Head("Begin after the due time", number=True), Head("Length of the work", number=True)]
    return [
        Section(
            "Deadlines",
            [
                Text(said),
                Facts([(f"Would have met {rate}", verdict) for rate, verdict in timing_text.verdicts(timing)]),
                Table("Percentiles over all controller steps", heads, rows),
                *([Table("Number of controller steps", of_buckets, buckets)] if buckets else []),
            ],
        )
    ]
