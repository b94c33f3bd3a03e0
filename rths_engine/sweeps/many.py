"""The points of a sweep in several processes of this machine."""

from __future__ import annotations

import os
import signal
from collections.abc import Generator, Sequence
from multiprocessing import get_context
from pathlib import Path

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.sweeps.columns import Column
from rths_engine.sweeps.design import Design
from rths_engine.sweeps.running import Points, Row

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # the processes share the cores
_points: list[Points] = []


def rows(
    design: Design, columns: tuple[Column, ...], motions: Path | None, points: Sequence[int], processes: int
) -> Generator[tuple[int, Row], None, None]:
    """The rows of points (from 0) as they end, in any order. A consumer that stops early ends the processes."""
    if min(processes, len(points)) < 2:
        own = Points(design, columns, MotionLibrary(motions))
        for point in points:
            row = own.row(point)
            assert row is not None
            yield point, row
        return
    os.environ.update(ONE_THREAD)  # read where the processes load numpy
    given = (design, columns, motions)
    with get_context("spawn").Pool(min(processes, len(points)), _prepare, given) as pool:
        yield from pool.imap_unordered(_row, points)


def _prepare(design: Design, columns: tuple[Column, ...], motions: Path | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C also reaches the parent, which ends this process
    _points.append(Points(design, columns, MotionLibrary(motions)))


def _row(point: int) -> tuple[int, Row]:
    row = _points[0].row(point)
    assert row is not None
    return point, row
