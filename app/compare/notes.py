"""What an overlay does not say, in words: differences of excitation, kind, sampling, duration, stations and channels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from app.compare.excitations import by_plan, by_signals, grouped, joined, lower
from app.compare.items import Item
from app.compare.schemas import NoteOut
from app.reports.digits import short
from app.shown import KINDS
from rths_engine.planning.differences import FieldDifference
from rths_engine.results.channels import CHANNELS

DRAWN = ("x_cmd", "x_meas", "f_meas", "error", "ti", "d_alpha", "x_floor")  # roles of the charts
ORDER_OF_START = 1e-9  # s; equal starts differ by rounding


def notes(items: Sequence[Item], reference: int, rows: Sequence[FieldDifference]) -> list[NoteOut]:
    """The differences of the items in words, the most important first. `rows` are the differences of the plans."""
    labels = [one.label for one in items]
    planned = [one.label for one in items if one.plan is not None]
    others = [one for k, one in enumerate(items) if k != reference]
    excited = [*by_plan(rows, planned), *by_signals(items[reference], others)]
    found = [NoteOut(about="excitation", sentence=f"The excitations differ: {'; '.join(excited)}.")] if excited else []
    tests = [KINDS.get(one.row.test or "", "not stated") for one in items]
    found += _differ("test", "The kinds of test differ", tests, labels, "")
    rates = [f"{short(1 / one.recording.dt)} Hz" for one in items]
    found += _differ("sampling", "The sampling rates differ", rates, labels, "Each curve has its own samples.")
    found += _durations(items, labels)
    starts = [f"{short(_start(one))} s" for one in items]
    found += _differ("start", "The first samples are at different times", starts, labels, "No curve is shifted.")
    stations = [str(len(one.stations)) for one in items]
    found += _differ("stations", "The numbers of stations differ", stations, labels, "")
    return [*found, *_channels(items), *_computed(items), *_plans(items)]


def _differ(about: str, what: str, texts: Sequence[str], labels: Sequence[str], then: str) -> Iterator[NoteOut]:
    if len(set(texts)) > 1:
        yield NoteOut.model_validate({"about": about, "sentence": f"{what}: {grouped(texts, labels)}. {then}".rstrip()})


def _start(item: Item) -> float:
    """Time of the start: 0 for a run, whose first sample is one controller step later."""
    start = 0.0 if item.run else item.recording.start
    return 0.0 if abs(start) < ORDER_OF_START else start


def _durations(items: Sequence[Item], labels: Sequence[str]) -> Iterator[NoteOut]:
    ended = [f" ({one.run.state})" if one.run and one.run.state != "completed" else "" for one in items]
    texts = [f"{short(one.recording.duration)} s{state}" for one, state in zip(items, ended, strict=True)]
    yield from _differ("duration", "The durations differ", texts, labels, "Each curve ends at its last sample.")


def _channels(items: Sequence[Item]) -> Iterator[NoteOut]:
    """Channels of the charts that some items lack; a station or floor that an item lacks is one fact, not one a channel."""
    known = {name for one in items for name in (*one.recording.keys, *one.recording.computed)}
    lacking: dict[tuple[str, ...], list[str]] = {}
    for role in DRAWN:
        for name in sorted((name for name in known if name.partition(".")[0] == role), key=_number):
            without = tuple(one.label for one in items if not one.recording.has(name) and _could_have(one, name))
            if without:
                lacking.setdefault(without, []).append(f"{lower(CHANNELS[role].label)} ({name})")
    for without, channels in lacking.items():
        verb = "have" if len(without) > 1 else "has"
        yield NoteOut(about="channels", sentence=f"{joined(without)} {verb} no {', no '.join(channels)}.")


def _number(name: str) -> int:
    return int(name.partition(".")[2] or 0)


def _could_have(item: Item, name: str) -> bool:
    role, _, number = name.partition(".")
    if CHANNELS[role].counts == "station":
        return any(one == int(number) for one, _ in item.stations)
    return not item.floors or int(number) <= item.floors


def _computed(items: Sequence[Item]) -> Iterator[NoteOut]:
    some = [one.label for one in items if one.recording.computed]
    if some:
        what = "tracking error and tracking indicator"
        yield NoteOut(
            about="computed", sentence=f"The {what} of {joined(some)} are computed from its command and displacement."
        )


def _plans(items: Sequence[Item]) -> Iterator[NoteOut]:
    without = [one.label for one in items if one.plan is None]
    if without:
        rest = "has no plan: it was imported" if len(without) == 1 else "have no plan: they were imported"
        yield NoteOut(about="plan", sentence=f"{joined(without)} {rest}.")
