"""`rths sweep`: execute a sweep on all cores of this machine, without a server."""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from argparse import Namespace
from contextlib import closing
from pathlib import Path
from types import FrameType
from typing import Any

from tqdm import tqdm

from app.cli.main import DONE, INTERRUPTED
from app.cli.run_input import check_folder
from app.cli.settings import settings
from app.store.filed import MOTIONS
from app.store.opening import store_of
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, MotionError, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import plan_yaml
from rths_engine.sweeps.columns import STATUSES, columns
from rths_engine.sweeps.design import Design, read_design
from rths_engine.sweeps.many import rows
from rths_engine.sweeps.partial import SUFFIX, Partial
from rths_engine.sweeps.table import SUFFIXES, Table, write


def sweep(given: Namespace) -> int:
    """`rths sweep`: execute a sweep, or only count its points. Exit code: 0 done, 2 invalid input, 130 interrupted."""
    motions = store_of(settings(given)).folder(MOTIONS)
    design = _design(given.sweep, MotionLibrary(motions))
    if given.count:
        print(json.dumps({"points": design.count, "notes": design.notes}) if given.json else _counted(design))
        return DONE
    out = given.out or Path(f"{given.sweep.stem}.csv")
    check_folder(out, example="results.csv")
    if out.suffix not in SUFFIXES:
        raise RthsError(
            Issue("--out", f"needs a name that ends with {', '.join(SUFFIXES)}", str(out), "for example results.csv")
        )
    own, partial = columns(design), Partial(out.with_name(out.name + SUFFIX), design)
    done, start = len(partial.rows), time.perf_counter()
    left = [point for point in range(design.count) if point not in partial.rows]
    whole = True
    with (
        partial,
        tqdm(total=design.count, initial=done, unit="point", disable=None, file=sys.stderr) as bar,
        _Interrupt() as interrupt,
        closing(rows(design, own, motions, left, given.processes or os.cpu_count() or 1)) as found,
    ):
        for point, row in found:
            partial.add(point, row)
            bar.update()
            if interrupt.asked and len(partial.rows) < design.count:
                whole = False
                break
    table = partial.table(own)
    with files.temporary(out) as written:
        with written.open("wb") as file:
            write(table, out, file)
        os.replace(written, out)
    if whole:
        partial.path.unlink()
    elapsed_s, executed = time.perf_counter() - start, len(partial.rows) - done
    print(json.dumps(_as_dict(design, table)) if given.json else _text(design, table, executed, elapsed_s, out, whole))
    return DONE if whole else INTERRUPTED


class _Interrupt:
    """Notes that Ctrl-C was pressed, so that the sweep ends after the present point. A second Ctrl-C ends it at once."""

    def __enter__(self) -> _Interrupt:
        self.asked = False
        self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)

    def _note(self, _: int, __: FrameType | None) -> None:
        if self.asked:
            raise KeyboardInterrupt
        self.asked = True


def _design(path: Path, library: MotionLibrary) -> Design:
    """The design of a sweep in a file. A plan in another file is named by its path beside it. Raises RthsError."""
    data = plan_yaml.parse(_text_of(path, "SWEEP.yaml"))
    if isinstance(data, dict) and isinstance(data.get("plan"), str) and data["plan"].endswith((".yaml", ".yml", ".json")):
        data = {**data, "plan": plan_yaml.parse(_text_of(path.parent / data["plan"], "plan"))}
    design = read_design(data)
    for place, name in enumerate(design.records):
        try:
            library.get(name)
        except MotionError as error:
            raise MotionError(Issue(f"records.{place}", one.problem, one.value, one.fix) for one in error.issues) from None
    return design


def _text_of(path: Path, where: str) -> str:
    try:
        with path.open(encoding="utf-8") as file:
            return file.read(plan_yaml.LARGEST + 1)
    except UnicodeDecodeError:
        raise PlanError(Issue(where, "is not valid UTF-8 text", str(path))) from None
    except OSError as error:
        raise PlanError(Issue(where, f"cannot be read: {error.strerror}", str(path), "see docs/sweeps.md")) from None


def _counted(design: Design) -> str:
    parts = [f"{len(design.records)} records"] if design.records else []
    parts += [f"{len(design.scales.levels)} scales"] if design.scales else []
    of_fields = f"{design.rows} of the fields ({design.definition.method})"
    return "\n".join([f"{design.count} points: {' × '.join([*parts, of_fields])}", *design.notes])


def _text(design: Design, table: Table, executed: int, elapsed_s: float, out: Path, whole: bool) -> str:
    place = [column.key for column in table.columns].index("status")
    found = table.texts(place)
    counts = ", ".join(f"{found.count(status)} {status}" for status in STATUSES if status in found)
    rate = f"{executed} points in {elapsed_s:.1f} s ({executed / elapsed_s:.1f} points/s)"
    lines = [
        f"{design.definition.name}: {len(table.points)} of {design.count} points: {counts or 'none'}.",
        f"{rate}. Results: {out}",
    ]
    reasons = [f"Point {point + 1}: {reason}" for point, reason in table.reasons.items()]
    lines += [*reasons[:3], *([f"and {len(reasons) - 3} more, in the column reason"] if len(reasons) > 3 else [])]
    return "\n".join(lines if whole else [*lines, "Interrupted: the same command executes the other points."])


def _as_dict(design: Design, table: Table) -> dict[str, Any]:
    own = [column.as_dict() for column in table.columns]
    return {"name": design.definition.name, "points": design.count, "columns": own, "values": table.as_dict()}
