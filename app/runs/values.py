"""Values of runs by which lists sort and filter: scalar fields of the plan, and measures of stations and floors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session, UOWTransaction

from app.db import INSERT
from app.models import LONGEST_VALUE, Run, RunStation, RunValue, ValuePath
from rths_engine.results.measure import FloorMeasure, StationMeasure
from rths_engine.results.measures import of

PLAN = "plan."
LARGEST = "max"
# text for people, checksums and tables of samples are no columns
LEFT_OUT = frozenset({"schema", "name", "notes", "template", "test", "known", "sha256", "acceleration"})
LONGEST_LIST = 32  # scalars of a list that become columns; longer lists are samples

Scalar = float | str
Row = tuple[int, str, Scalar]
"""Number of the run, path, and value."""


def plan_values(plan: dict[str, Any]) -> Iterator[tuple[str, Scalar]]:
    """The scalar fields of a plan by path, such as `plan.stations.0.compensator.alpha`; numbers are SI."""
    for name, value in plan.items():
        if name not in LEFT_OUT:
            yield from _flat(f"{PLAN}{name}", value)


def station_values(station: RunStation) -> Iterator[tuple[str, Scalar]]:
    """The measures of a station by key and number, such as `mte_mm:1`, in the unit shown."""
    for one in of(StationMeasure):
        value = station.measure(one.key)
        if value is not None:
            yield f"{one.key}:{station.number}", value


def largest_values(run: Run) -> Iterator[tuple[str, Scalar]]:
    """Measures at the largest magnitude of all stations or floors, such as `mte_mm:max`, and those of each floor."""
    for one in of(StationMeasure):
        found = [value for station in run.stations if (value := station.measure(one.key)) is not None]
        if found:
            yield f"{one.key}:{LARGEST}", max(found, key=abs)
    for floor in of(FloorMeasure):
        peaks = getattr(run, floor.key) or []
        found = [peak for peak in peaks if peak is not None]
        yield from ((f"{floor.key}:{number}", peak) for number, peak in enumerate(peaks, start=1) if peak is not None)
        if found:
            yield f"{floor.key}:{LARGEST}", max(found, key=abs)


def write(connection: sa.Connection, rows: Iterable[Row]) -> None:
    """Store values, in place of earlier ones at the same run and path."""
    given = list(rows)
    ids = _ids(connection, {path for _, path, _ in given})
    values = [{"path_id": ids[path], "run_number": number, **_stored(value)} for number, path, value in given]
    if values:
        insert = INSERT[connection.dialect.name](RunValue)
        new = {"number": insert.excluded.number, "text": insert.excluded.text}
        # the order of the table: neighbouring rows are written together
        values.sort(key=lambda row: (row["path_id"], row["run_number"]))
        connection.execute(insert.on_conflict_do_update(index_elements=["path_id", "run_number"], set_=new), values)


def remove(session: Session, number: int) -> None:
    """Remove the values of a run."""
    paths = sa.select(ValuePath.id)
    session.execute(sa.delete(RunValue).where(RunValue.path_id.in_(paths), RunValue.run_number == number))


@sa.event.listens_for(Session, "after_flush")
def _follow(session: Session, _: UOWTransaction) -> None:
    """Write the values of new runs and of new results, in the transaction that stores them."""
    runs = [one for one in session.new if isinstance(one, Run)]
    stations = [one for one in session.new if isinstance(one, RunStation)]
    measured = {one.number: one for one in runs if one.stations} | {one.run.number: one.run for one in stations}
    measured |= {one.number: one for one in session.dirty if isinstance(one, Run) and _has_new_floors(one)}
    rows: list[Row] = [(run.number, path, value) for run in runs for path, value in plan_values(run.plan)]
    rows += [(one.run_number, path, value) for one in stations for path, value in station_values(one)]
    rows += [(run.number, path, value) for run in measured.values() for path, value in largest_values(run)]
    if rows:
        write(session.connection(), rows)


def _has_new_floors(run: Run) -> bool:
    return any(sa.inspect(run).attrs[floor.key].history.has_changes() for floor in of(FloorMeasure))


def _flat(path: str, value: Any) -> Iterator[tuple[str, Scalar]]:
    if isinstance(value, dict):
        for name, inner in value.items():
            if name not in LEFT_OUT:
                yield from _flat(f"{path}.{name}", inner)
    elif isinstance(value, list):
        if len(value) <= LONGEST_LIST:
            for index, inner in enumerate(value):
                if not isinstance(inner, list):
                    yield from _flat(f"{path}.{index}", inner)
    elif value is not None and len(path) <= LONGEST_VALUE:
        yield path, "yes" if value is True else "no" if value is False else value


def _stored(value: Scalar) -> dict[str, Any]:
    return {"number": None, "text": value[:LONGEST_VALUE]} if isinstance(value, str) else {"number": float(value), "text": None}


def _ids(connection: sa.Connection, paths: set[str]) -> dict[str, int]:
    """The ids of paths; a path that is not known yet is added."""
    found = _known(connection, paths)
    if missing := sorted(paths - found.keys()):
        add = INSERT[connection.dialect.name](ValuePath).on_conflict_do_nothing()
        connection.execute(add, [{"path": path} for path in missing])
        found |= _known(connection, set(missing))
    return found


def _known(connection: sa.Connection, paths: set[str]) -> dict[str, int]:
    ordered = sorted(paths)
    found: dict[str, int] = {}
    for first in range(0, len(ordered), 500):  # bound parameters of one statement are limited
        part = sa.select(ValuePath.path, ValuePath.id).where(ValuePath.path.in_(ordered[first : first + 500]))
        found |= {path: number for path, number in connection.execute(part)}
    return found
