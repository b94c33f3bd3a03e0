"""The result of a run as text: measures with units, beside the paper's for a simulation of Table III."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from app.shown import SILENT
from rths_engine.planning.plan import Plan
from rths_engine.planning.templates import PAPER

# field of a station's summary -> heading with unit, decimals
COLUMNS = {
    "mte_mm": ("MTE mm", 2),
    "rms_percent": ("RMS %", 2),
    "mti_mm2": ("MTI mm²", 1),
    "mee_kNm": ("MEE kN·m", 2),
    "peak_stroke_mm": ("Stroke mm", 1),
    "peak_force_kN": ("Force kN", 1),
}
BEYOND = {
    "fei_delay_ms": ("FEI delay ms", 2),
    "fei_amplitude": ("FEI amplitude", 4),
    "delay_ms": ("Delay ms", 2),
    "nrms_percent": ("NRMSE %", 2),
    "peak_error_percent": ("Peak error %", 2),
    "energy_error_percent": ("HSEE %", 2),
}
LEAST_NAME = 8


def text(plan: Plan, summary: dict[str, Any], out: Path | None) -> str:
    """The measures of a run as lines for a terminal."""
    return "\n".join(_lines(plan, summary, out))


def _lines(plan: Plan, summary: dict[str, Any], out: Path | None) -> Iterator[str]:
    yield f"{plan.name}: {summary['status']}"
    if summary["trip"]:
        yield summary["trip"]["sentence"]
    yield f"{summary['simulated_s']:.2f} s simulated in {summary['elapsed_s']:.2f} s"
    stations = summary["stations"]
    columns, beyond = (_telling(plan, table) for table in (COLUMNS, BEYOND))
    if stations:
        yield ""
        width = max(LEAST_NAME, *(len(station["name"]) for station in stations))
        yield _row("Station", [heading for heading, _ in columns.values()], width)
        for number, station in enumerate(stations):
            yield _row(station["name"], _cells(station, columns), width)
            paper = _paper(plan, number)
            if paper:
                yield _row("  paper", paper, width)
        yield ""
        yield _row("Station", [heading for heading, _ in beyond.values()], width)
        for station in stations:
            yield _row(station["name"], _cells(station, beyond), width)
        yield ""
    if summary["floors_peak_mm"]:
        peaks = ", ".join(f"floor {number} {peak:.1f}" for number, peak in enumerate(summary["floors_peak_mm"], start=1))
        yield f"Peak displacement, mm: {peaks}"
    if summary["input_energy_kNm"]:
        yield f"Input energy, kN·m: {summary['input_energy_kNm']:.1f}"
    if out:
        yield f"Recording: {out} ({out.stat().st_size / 1e6:.1f} MB)"


def _telling(plan: Plan, table: dict[str, tuple[str, int]]) -> dict[str, tuple[str, int]]:
    return {field: column for field, column in table.items() if field not in SILENT.get(plan.test, ())}


def _row(name: str, cells: list[str], width: int) -> str:
    return f"{name:{width}}" + "".join(f"{cell:>14}" for cell in cells)


def _cells(station: dict[str, Any], columns: dict[str, tuple[str, int]]) -> list[str]:
    return ["–" if station[field] is None else f"{station[field]:z.{digits}f}" for field, (_, digits) in columns.items()]


def _paper(plan: Plan, station: int) -> list[str]:
    """The paper's measures of a station, or nothing: another plan, or its test was unstable."""
    row = PAPER.get(plan.template or "")
    if row is None or row.mte_mm is None:
        return []
    published = [getattr(row, field, None) for field in COLUMNS]
    return [f"{pair[station]:g}" if pair and station < len(pair) else "–" for pair in published]
