"""The twelve simulations of Table IV as text, beside the paper's values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rths_engine import table4 as engine
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import Motion
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.results.measures import measure
from rths_engine.table4.comparison import CALIBRATED, MEASURES, published, stable

# field -> heading, decimals as published
COLUMNS = {key: (measure(key).heading, 1) for key in MEASURES}
WIDTH = 19


def text(
    planned: engine.PlannedRecord,
    motion: Motion,
    rows: Sequence[engine.Row],
    floors: Sequence[float],
    drifts: Sequence[float],
    elapsed_s: float,
) -> str:
    """Table IV as text; each row has the paper's row below it."""
    return "\n".join([*_head(planned, motion), *_table(rows), *_foot(rows, floors, drifts), f"Run in {elapsed_s:.2f} s."])


def _head(planned: engine.PlannedRecord, motion: Motion) -> Iterator[str]:
    assert isinstance(planned.scale, Factor)
    yield "Table IV of Chen and Ricles (2012), first storey / second storey; the paper's values are below ours"
    yield (
        f"Record {motion.title}: {len(motion.acceleration)} values every {motion.dt:g} s, "
        f"scaled by {planned.scale.factor:.4g}, scaled peak {motion.pga / STANDARD_GRAVITY:.3f} g"
    )
    yield ""


def _table(rows: Sequence[engine.Row]) -> Iterator[str]:
    yield _line("#", "outcome", [heading for heading, _ in COLUMNS.values()])
    for row in rows:
        paper = engine.PAPER[row.simulation]
        outcome = f"tripped {row.trip_s:.2f} s" if row.trip_s is not None else row.status
        ours = [_pair([station[field] for station in row.stations], digits) for field, (_, digits) in COLUMNS.items()]
        yield _line(str(row.simulation), outcome, ours)
        if stable(paper):
            given = [_pair([published(paper, field, j) for j in range(2)], digits) for field, (_, digits) in COLUMNS.items()]
            yield _line("", "  paper", given)
        else:
            yield _line("", "  paper: unstable", [])


def _foot(rows: Sequence[engine.Row], floors: Sequence[float], drifts: Sequence[float]) -> Iterator[str]:
    found = engine.comparison(rows)
    yield ""
    yield f"Floor peaks of simulation 2: {_pair(floors, 1)} mm (paper {_pair(engine.FLOORS_PEAK_MM, 1)} mm)"
    yield f"Storey drifts of simulation 2: {_pair(drifts, 2)} % (paper {_pair(engine.DRIFTS_PERCENT, 1)} %)"
    wrong = f"; different from the paper: {', '.join(map(str, found.outcomes_wrong))}" if found.outcomes_wrong else ""
    yield f"Outcomes as in the paper: {found.outcomes_right} of {len(rows)}{wrong}"
    signs = f"; different: {'; '.join(found.signs_wrong)}" if found.signs_wrong else ""
    yield f"Signs of MTI and MEE as in the paper: {found.signs_right} of {found.signs_right + len(found.signs_wrong)}{signs}"
    yield f"MTE, RMS and MTI differ from the paper by a factor of {found.median:.2f} (median), {found.worst:.2f} (largest)"
    fitted = " and ".join(map(str, CALIBRATED))
    yield f"Parameters were fitted to simulations {fitted} only. docs/table4.md lists all assumptions."


def _line(number: str, outcome: str, cells: Sequence[str]) -> str:
    return f"{number:>3}  {outcome:<16}" + "".join(f"{cell:>{WIDTH}}" for cell in cells)


def _pair(values: Sequence[float], digits: int) -> str:
    return " / ".join(f"{value:.{digits}f}" for value in values)
