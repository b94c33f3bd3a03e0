"""The result of a run as text: measures with units, and the paper's measures for a simulation of Table III."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rths_engine.planning.paper import PAPER
from rths_engine.planning.plan import Plan
from rths_engine.results import timing_text
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

LEAST_NAME, LEAST_CELL, GAP = 8, 12, 2  # characters


def text(plan: Plan, summary: dict[str, Any], out: Path | None) -> str:
    """The measures of a run as lines for a terminal."""
    return "\n".join(_lines(plan, summary, out))


def _lines(plan: Plan, summary: dict[str, Any], out: Path | None) -> Iterator[str]:
    yield f"{plan.name}: {summary['status']}"
    if summary["trip"]:
        yield summary["trip"]["sentence"]
    yield f"{summary['simulated_s']:.2f} s simulated in {summary['elapsed_s']:.2f} s"
    if summary["stations"]:
        measures = of(StationMeasure, plan.test)
        yield from _table(plan, summary, [one for one in measures if not one.further], paper=True)
        yield from _table(plan, summary, [one for one in measures if one.further], paper=False)
        yield ""
    for floor in of(FloorMeasure, plan.test):
        values = list(enumerate(summary[floor.key], start=1))
        if not values:  # a measure against a reference, of a test that has none
            continue
        yield f"{floor.heading}: {', '.join(f'floor {number} {floor.text(value)}' for number, value in values)}"
    for whole in of(RunMeasure, plan.test):
        yield f"{whole.heading}: {whole.text(summary[whole.key])}"
    yield from _client(summary.get("client"))
    if summary.get("timing"):
        yield from timing_text.lines(summary["timing"])
    if out:
        yield f"Recording: {out} ({out.stat().st_size / 1e6:.1f} MB)"


def _client(client: dict[str, Any] | None) -> Iterator[str]:
    """The steps of the client of a test, and the warnings about it."""
    if client is None:
        return
    took = client["step_ms"]
    if took["median"] is not None:
        times = f"median {took['median']:.3g} ms, 95 % within {took['p95']:.3g} ms, longest {took['longest']:.3g} ms"
        yield f"Client at {client['peer']}: {client['steps']} steps, {times}"
    yield from (f"Warning: {one}" for one in client["warnings"])


def _table(plan: Plan, summary: dict[str, Any], measures: Sequence[Measure], paper: bool) -> Iterator[str]:
    """Table of the measures, one row a station; with `paper`, the published measures below each row."""
    stations = summary["stations"]
    first = max(LEAST_NAME, *(len(station["name"]) for station in stations))
    widths = [GAP + max(LEAST_CELL, len(one.heading)) for one in measures]
    yield ""
    yield _row("Station", [one.heading for one in measures], first, widths)
    for number, station in enumerate(stations):
        yield _row(station["name"], [one.text(station[one.key]) for one in measures], first, widths)
        published = _published(plan, number, measures) if paper else []
        if published:
            yield _row("  paper", published, first, widths)


def _row(name: str, cells: list[str], first: int, widths: list[int]) -> str:
    return f"{name:{first}}" + "".join(f"{cell:>{width}}" for cell, width in zip(cells, widths, strict=True))


def _published(plan: Plan, station: int, measures: Sequence[Measure]) -> list[str]:
    """The published measures of a station; empty for another plan, or where the paper's test was unstable."""
    row = PAPER.get(plan.template or "")
    pairs = [getattr(row, one.key, None) for one in measures]
    if not any(pairs):
        return []
    return [f"{pair[station]:g}" if pair and station < len(pair) else "–" for pair in pairs]
