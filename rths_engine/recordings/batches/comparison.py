"""The differences of each file of a batch: from the layout of most files, and from the values that most files share."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from rths_engine.recordings.batches.difference import NOTHING, SEVERITIES, Difference, Severity
from rths_engine.recordings.batches.facts import ColumnFacts, Facts
from rths_engine.recordings.batches.shared import Shared
from rths_engine.recordings.measured.mapping import Mapping

STEP_AGREES = 1e-3  # relative: rounding of time stamps; chosen, see docs/decisions/0023


def reference(files: Sequence[Facts | None], usable: Sequence[bool]) -> int | None:
    """The file that stands for the others: the first of the layout that most usable files have; None without any file."""
    known = [at for at, one in enumerate(files) if one is not None and usable[at]]
    known = known or [at for at, one in enumerate(files) if one is not None]
    fingerprints = {at: one.layout for at in known if (one := files[at]) is not None}
    count = Counter(fingerprints.values())
    return max(known, key=lambda at: (count[fingerprints[at]], -at), default=None)


def compared(files: Sequence[Facts | None], usable: Sequence[bool], mapping: Mapping) -> list[list[Difference]]:
    """The differences of each file; none for a file that cannot be read."""
    at = reference(files, usable)
    usual = files[at] if at is not None else None
    if usual is None:
        return [[] for _ in files]
    shared = Shared([one for one, use in zip(files, usable, strict=True) if one is not None and use])
    return [_sorted([*_layout(one, usual, mapping), *shared.differences(one)]) if one is not None else [] for one in files]


def _sorted(found: Iterable[Difference]) -> list[Difference]:
    """The differences, those that refuse the file first; the most severe of those about the same thing."""
    ranked = sorted(found, key=lambda one: SEVERITIES.index(one.severity))
    return list({(one.what, one.of): one for one in reversed(ranked)}.values())[::-1]


def _layout(one: Facts, usual: Facts, mapping: Mapping) -> Iterator[Difference]:
    if one.format != usual.format:
        yield Difference("warning", "format", "", one.format, usual.format)
    yield from _columns(one, usual, _used_numbers(mapping))
    for selector in _selectors(mapping):
        yield from _meaning(one, usual, selector)
    for name, step in one.steps.items():
        other = usual.steps.get(name)
        if other is not None and abs(step / other - 1) > STEP_AGREES:
            severity: Severity = "warning" if mapping.times else "error"
            yield Difference(severity, "time step", f"column '{name}'", f"{step:.6g}", f"{other:.6g}")


def _columns(one: Facts, usual: Facts, by_number: bool) -> Iterator[Difference]:
    """Columns that are missing, added, renamed or in another order."""
    here, there = [each.name for each in one.columns], [each.name for each in usual.columns]
    missing, added = [each for each in there if each not in here], [each for each in here if each not in there]
    for name in list(missing):
        new = _renamed(usual.columns[there.index(name)], there.index(name), one, added)
        if new is not None:
            missing.remove(name)
            added.remove(new)
            yield Difference("note", "name", f"column {here.index(new) + 1}", new, name)
    for name in missing:
        yield Difference("note", f"column '{name}'", "", "missing", f"column {there.index(name) + 1}")
    for name in added:
        yield Difference("note", f"column '{name}'", "", f"column {here.index(name) + 1}", "missing")
    common = [each for each in here if each in there]
    if common != [each for each in there if each in here]:
        severity: Severity = "error" if by_number else "note"
        yield Difference(severity, "order of columns", "", ", ".join(here), ", ".join(there))


def _renamed(column: ColumnFacts, place: int, one: Facts, added: Iterable[str]) -> str | None:
    """The new name of a column: with the same words and another unit, else at the same place with the same unit."""
    new = [each for each in one.columns if each.name in added]
    same = [each.name for each in new if each.plain and each.plain == column.plain]
    if len(same) == 1:
        return same[0]
    at = one.columns[place] if place < len(one.columns) else None
    return at.name if at is not None and at in new and (at.unit, at.quantity) == (column.unit, column.quantity) else None


def _meaning(one: Facts, usual: Facts, selector: str | int) -> Iterator[Difference]:
    """Differences of a column that the mapping uses: another name at its number, another unit, quantity, scale or step."""
    here, there = one.column(selector), usual.column(selector)
    if there is None:
        return
    other = usual.columns[there]
    if here is None:
        here = next((at for at, each in enumerate(one.columns) if each.plain and each.plain == other.plain), None)
    if here is None:
        yield Difference("error", f"column '{other.name}'", "", "missing", f"column {there + 1}")
        return
    own = one.columns[here]
    of = f"column '{own.name}'"
    if isinstance(selector, int) and (own.plain, one.named) != (other.plain, usual.named):
        severity: Severity = "warning" if _same_signal(one, usual, here) else "error"
        yield Difference(severity, "name", f"column {selector}", own.name, other.name)
    if not one.named and len(one.columns) != len(usual.columns):
        yield Difference("error", "number of columns", "", str(len(one.columns)), str(len(usual.columns)))
    if own.unit != other.unit:
        yield Difference("error", "unit", of, own.unit or NOTHING, other.unit or NOTHING)
    if own.quantity != other.quantity:
        yield Difference("error", "quantity", of, own.quantity or NOTHING, other.quantity or NOTHING)
    if own.applied != other.applied:
        yield Difference("note", "scale or offset", of, own.applied or NOTHING, other.applied or NOTHING)


def _same_signal(one: Facts, usual: Facts, at: int) -> bool:
    """Whether a column with another name can only be the signal of the other files: their component has another azimuth.

    The format itself states its quantity, or it is the only column; and neither name stands at another number.
    """
    if len(one.columns) != len(usual.columns):
        return False
    own, other = one.columns[at], usual.columns[at]
    moved = other.plain in [each.plain for each in one.columns] or own.plain in [each.plain for each in usual.columns]
    return not moved and (len(one.columns) == 1 or (bool(own.quantity) and own.quantity == other.quantity))


def _selectors(mapping: Mapping) -> list[str | int]:
    """The columns that a mapping uses, each once."""
    used = [each for one in mapping.channels for each in (one.column, one.time) if each is not None]
    return list(dict.fromkeys(used))


def _used_numbers(mapping: Mapping) -> bool:
    return any(isinstance(one, int) for one in _selectors(mapping))
