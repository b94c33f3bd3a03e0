"""Rules of comparisons: which items can be compared, and what differs between them. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Sequence

from app.compare import items as named
from app.compare.items import Item, Ref
from app.compare.measures import measures, too_long
from app.compare.notes import DRAWN, notes
from app.compare.schemas import CandidateOut, ComparisonOut, FieldOut, ItemOut, NoteOut, PreviousOut, RoleOut, StationName
from app.compare.signals import Shown, packed
from app.config import Settings
from app.jobs.states import State
from app.measured.service import MeasuredService
from app.models import MeasuredRecording, Run
from app.runs.repository import Filter, Page
from app.runs.service import RunService
from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.planning.differences import FieldDifference, differences
from rths_engine.results.channels import CHANNELS

RECORDED = (State.COMPLETED, State.TRIPPED, State.CANCELLED)
OFFERED = 100  # runs, and recordings, to choose from
ORIGIN = ("template", "notes")  # fields that change no test: below those that do
LOOKED_AT = 200  # runs among which the previous run of a template is looked for


class CompareService:
    """Comparisons of 2 to 20 runs or imported recordings."""

    def __init__(self, runs: RunService, recordings: MeasuredService, settings: Settings):
        self.runs, self.recordings, self.settings = runs, recordings, settings

    def compare(self, given: Sequence[str], reference: str = "") -> ComparisonOut:
        """What differs between the items; `reference` names the item with which the others are compared, by default the first.

        Raises RthsError for a number of items out of range, NotFound, Conflict for a run without recording, and RecordingError.
        """
        refs = named.refs(given)
        named.counted(refs)
        index = _reference(refs, reference)
        found = self._opened(refs)
        plans = [one.plan for one in found if one.plan is not None]
        rows = sorted(differences(plans, leave_out=("name", "schema")), key=lambda row: row.path in ORIGIN)
        return ComparisonOut(
            items=[_item(one) for one in found],
            reference=index,
            notes=[*notes(found, index, rows), *_not_measured(found)],
            fields=[_field(row, found, index) for row in rows],
            measures=measures(found, index),
            roles=[_role(role) for role in DRAWN],
        )

    def signals(self, given: Sequence[str], shown: Shown) -> bytes:
        """The signals of a station and a floor of all items in a part of the time, decimated. Raises as `compare` does."""
        refs = named.refs(given)
        named.counted(refs)
        return packed(self._opened(refs), shown)

    def candidates(self, text: str = "") -> list[CandidateOut]:
        """The latest runs with a recording and the latest imported recordings, with `text` in the name."""
        runs, _ = self.runs.listed(Filter(states=RECORDED, text=text), Page(limit=OFFERED))
        imported, _ = self.recordings.listed(OFFERED, 0)
        return [
            *(_run(one) for one in runs if one.recording_sha256),
            *(_recording(one) for one in imported if text.lower() in one.name.lower()),
        ]

    def candidate(self, ref: Ref) -> CandidateOut:
        """A run or a recording by its name. Raises NotFound."""
        return _run(self.runs.get(ref.id)) if ref.kind == "run" else _recording(self.recordings.get(ref.id))

    def previous(self, run_id: str) -> PreviousOut:
        """The latest earlier run with a recording, of the same template, or of the same name without one. Raises NotFound."""
        run = self.runs.get(run_id)
        alike = Filter(states=RECORDED, template=run.template) if run.template else Filter(states=RECORDED, text=run.name)
        listed, _ = self.runs.listed(alike, Page(limit=LOOKED_AT))
        earlier = [one for one in listed if one.number < run.number and one.recording_sha256]
        same = [one for one in earlier if run.template or one.name == run.name]
        if not same:
            return PreviousOut(previous=None, address=None)
        found = _run(same[0])
        return PreviousOut(previous=found, address=address([found.ref, f"run:{run.id}"]))

    def _opened(self, refs: Sequence[Ref]) -> list[Item]:
        return [named.opened(ref, self.runs, self.recordings, self.settings) for ref in refs]


def address(refs: Sequence[str], reference: str = "") -> str:
    """The permanent link of a comparison."""
    return f"/compare?items={','.join(refs)}" + (f"&reference={reference}" if reference else "")


def _reference(refs: Sequence[Ref], reference: str) -> int:
    if not reference:
        return 0
    names = [str(ref) for ref in refs]
    if reference not in names:
        raise RthsError(Issue("reference", "is not one of the items", reference, f"give one of {', '.join(names)}"))
    return names.index(reference)


def _item(item: Item) -> ItemOut:
    row, recording = item.row, item.recording
    return ItemOut(
        ref=str(item.ref),
        kind=item.ref.kind,
        id=row.id,
        label=item.label,
        name=row.name,
        test=row.test,
        state=item.run.state if item.run else None,
        reason=item.run.reason if item.run else None,
        has_plan=item.plan is not None,
        dt_s=recording.dt,
        rate_hz=1 / recording.dt,
        start_s=recording.start,
        duration_s=recording.duration,
        samples=recording.samples,
        stations=[StationName(number=number, name=name) for number, name in item.stations],
        floors=item.floors,
        channels=list(recording.keys),
        computed=list(recording.computed),
    )


def _field(row: FieldDifference, found: Sequence[Item], reference: int) -> FieldOut:
    """A row for all items: those without plan have neither value nor text."""
    places = iter(range(len(row.texts)))
    at = [next(places) if one.plan is not None else None for one in found]
    base = at[reference] if at[reference] is not None else 0
    assert base is not None
    return FieldOut(
        path=row.path,
        within=row.within,
        label=row.label,
        unit=row.unit,
        values=[None if k is None else row.values[k] for k in at],
        texts=[None if k is None else row.texts[k] for k in at],
        differs=[k is not None and row.texts[k] != row.texts[base] for k in at],
    )


def _role(role: str) -> RoleOut:
    one = CHANNELS[role]
    return RoleOut(role=role, label=one.label, unit=units.pretty(one.shown))


def _not_measured(found: Sequence[Item]) -> list[NoteOut]:
    long = [one.label for one in found if too_long(one)]
    sentence = f"The measures of {', '.join(long)} are not computed: the recording is too long."
    return [NoteOut(about="measures", sentence=sentence)] if long else []


def _run(run: Run) -> CandidateOut:
    return CandidateOut(
        ref=f"run:{run.id}",
        label=f"Run {run.number}",
        name=run.name,
        test=run.test,
        state=run.state,
        at=run.submitted_at.strftime("%Y-%m-%d %H:%M"),
    )


def _recording(one: MeasuredRecording) -> CandidateOut:
    return CandidateOut(
        ref=f"recording:{one.id}",
        label=f"Recording {one.number}",
        name=one.name,
        test=one.test,
        state=None,
        at=one.imported_at.strftime("%Y-%m-%d %H:%M"),
    )
