"""The items of a comparison: read from the address, with the rows and the recordings that they name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from app.config import Settings
from app.measured.service import MeasuredService
from app.models import MeasuredRecording, Run
from app.problems import Conflict
from app.runs.exports import recording_path, removed
from app.runs.service import RunService
from rths_engine.foundation.errors import Issue, RecordingError, RthsError
from rths_engine.recordings import selected
from rths_engine.recordings.selected import Selection

FEWEST, MOST = 2, 20
KINDS: tuple[Literal["run"], Literal["recording"]] = ("run", "recording")
FORM = "write run:ID or recording:ID"


@dataclass(frozen=True, slots=True)
class Ref:
    """The name of an item: its kind and identifier."""

    kind: Literal["run", "recording"]
    id: str

    def __str__(self) -> str:
        return f"{self.kind}:{self.id}"


@dataclass(frozen=True, slots=True)
class Item:
    """A run or an imported recording: its row, its recording on disk, and its plan in JSON form, which a run has."""

    ref: Ref
    row: Run | MeasuredRecording
    recording: Selection

    @property
    def run(self) -> Run | None:
        return self.row if isinstance(self.row, Run) else None

    @property
    def label(self) -> str:
        return f"{self.ref.kind.capitalize()} {self.row.number}"

    @property
    def plan(self) -> dict[str, Any] | None:
        return self.run.plan if self.run else None

    @property
    def stations(self) -> list[tuple[int, str]]:
        """Number and name of each station."""
        if self.run:
            return [(k, station["name"]) for k, station in enumerate(self.run.plan.get("stations", []), start=1)]
        found = self._numbers(("x_cmd", "x_comp", "x_meas", "f_meas"))
        return [(number, f"Station {number}") for number in found]

    @property
    def floors(self) -> int:
        return max(self._numbers(("x_floor",)), default=0)

    def _numbers(self, roles: Sequence[str]) -> list[int]:
        split = (key.partition(".") for key in self.recording.keys)
        return sorted({int(number) for role, _, number in split if role in roles and number})


def refs(given: Sequence[str]) -> list[Ref]:
    """The items named in an address: each text names one item, or several with commas. Raises RthsError."""
    texts = [one.strip() for text in given for one in text.split(",") if one.strip()]
    found: list[Ref] = []
    for index, text in enumerate(texts):
        kind, colon, name = text.partition(":")
        if kind not in KINDS or not colon or not name:
            raise RthsError(Issue(f"items.{index}", "does not name a run or a recording", text, FORM))
        ref = Ref(kind, name)
        if ref in found:
            raise RthsError(Issue(f"items.{index}", "is given twice", text, "name each item once"))
        found.append(ref)
    return found


def counted(found: Sequence[Ref]) -> None:
    """Raises RthsError unless there are 2 to 20 items."""
    if not FEWEST <= len(found) <= MOST:
        raise RthsError(Issue("items", f"needs {FEWEST} to {MOST} items; the number given is {len(found)}", None, FORM))


def opened(ref: Ref, runs: RunService, recordings: MeasuredService, settings: Settings) -> Item:
    """An item with its recording. Raises NotFound, Conflict for a run without recording, and RecordingError."""
    if ref.kind == "recording":
        row = recordings.get(ref.id)
        return Item(ref, row, selected.of_measured(recordings.hdf5(row.id)))
    run = runs.get(ref.id)
    if not run.recording_sha256:
        why = "wait until it has ended" if not run.state.ended else "choose another run"
        said = removed(run) or f"Run {run.number} ({run.name}) has no recording: it is {run.state}."
        raise Conflict(f"{said} To compare runs, {why}.")
    path = recording_path(run, settings)
    try:
        return Item(ref, run, selected.of_run(path))
    except RecordingError as error:
        raise RecordingError(Issue("", f"the recording of run {run.number} ({run.name}) cannot be read: {error}")) from None
