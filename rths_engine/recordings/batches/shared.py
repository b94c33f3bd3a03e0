"""Values that more than half of the files of a batch share, and the differences of a file from them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from statistics import median
from typing import TypeVar

from rths_engine.recordings.batches import slips
from rths_engine.recordings.batches.difference import NOTHING, Difference
from rths_engine.recordings.batches.facts import ChannelFacts, Facts, RecordingFacts

# chosen; see docs/decisions/0023
FAR = 30  # between the largest values of a channel in two files
ALIKE = 0.2  # relative: largest values of repeated tests; where most files are so alike, a smaller ratio is looked at too
FEWEST = 3  # files of which most can share a value

_CLOCK = (("rate_hz", "sampling rate", "Hz"), ("start_s", "start", "s"), ("duration_s", "duration", "s"))
_STATED = ("not stated", "stated")
_VARIES = ("varies", "constant")

T = TypeVar("T")


class Shared:
    """What most of `files` share: clock, statements and entries of the header, and the sizes of their channels."""

    def __init__(self, files: Sequence[Facts]):
        recordings = [one.recording for one in files if one.recording is not None]
        self._clock = {name: _most([getattr(one, name) for one in recordings]) for name, _, _ in _CLOCK}
        self._samples = _most([one.samples for one in recordings])
        self._stated = {what: _most([what in one.stated for one in files]) for what in _all(one.stated for one in files)}
        self._about = {name: _most([one.about.get(name, "") for one in files]) for name in _all(one.about for one in files)}
        keys = _all(one.channels for one in recordings)
        channels = {key: [one.channels[key] for one in recordings if key in one.channels] for key in keys}
        self._constant = {key: _most([one.constant for one in each]) for key, each in channels.items()}
        many = {key: each for key, each in channels.items() if len(each) >= FEWEST}
        self._middle = {key: median(one.largest for one in each) for key, each in many.items()}
        self._scatter = {key: _scatter([one.largest for one in each], self._middle[key]) for key, each in many.items()}
        self._mean = {key: median(abs(one.mean) for one in each) for key, each in many.items()}
        self._of_means = {key: _scatter([abs(one.mean) for one in each], self._mean[key]) for key, each in many.items()}

    def differences(self, one: Facts) -> Iterator[Difference]:
        """The differences of a file from what most files share."""
        if one.recording is not None:
            yield from self._times(one.recording)
            for key, channel in one.recording.channels.items():
                yield from self._channel(key, channel, one.recording)
        for what, usual in self._stated.items():
            if usual is not None and (what in one.stated) != usual:
                yield Difference("note", "statement in the header", what, _STATED[what in one.stated], _STATED[usual])
        for name, text in self._about.items():
            if text is not None and one.about.get(name, "") != text:
                yield Difference("note", "entry of the header", name, one.about.get(name) or NOTHING, text or NOTHING)

    def _times(self, own: RecordingFacts) -> Iterator[Difference]:
        for name, what, unit in _CLOCK:
            here, usual = getattr(own, name), self._clock[name]
            if usual is not None and here != usual:
                severity = "warning" if name == "rate_hz" else "note"
                yield Difference(severity, what, "", f"{here:.6g} {unit}", f"{usual:.6g} {unit}")  # type: ignore[arg-type]
        if self._samples is not None and own.samples != self._samples:
            yield Difference("note", "number of samples", "", str(own.samples), str(self._samples))

    def _channel(self, key: str, own: ChannelFacts, of: RecordingFacts) -> Iterator[Difference]:
        constant, middle = self._constant.get(key), self._middle.get(key, 0.0)
        if constant is not None and own.constant != constant:
            yield Difference("warning", "signal", key, _VARIES[own.constant], _VARIES[constant])
        if not (middle > 0 and own.largest > 0):
            return
        ratio, mean = own.largest / middle, self._mean[key]
        another_test = self._all_by(ratio, key, of)
        slipped = "" if another_test else slips.between(own.largest, middle, own.unit, self._scatter[key])
        if slipped or not 1 / FAR < ratio < FAR:
            there = f"{middle:.3g} {own.unit} (median{slipped and f'; {slipped}'})"
            yield Difference("warning", "largest value", key, f"{own.largest:.3g} {own.unit}", there)
        elif not another_test and (slipped := slips.between(abs(own.mean), mean, own.unit, self._of_means[key])):
            yield Difference("warning", "mean", key, f"{own.mean:.3g} {own.unit}", f"{mean:.3g} {own.unit} (median; {slipped})")

    def _all_by(self, ratio: float, key: str, of: RecordingFacts) -> bool:
        """Whether every other channel of the file is larger by the same ratio: another amplitude, not another unit."""
        others = [
            one.largest / middle
            for other, one in of.channels.items()
            if other != key and (middle := self._middle.get(other, 0.0)) > 0 and one.largest > 0
        ]
        return bool(others) and all(abs(one / ratio - 1) <= ALIKE for one in others)


def _scatter(sizes: Sequence[float], middle: float) -> float | None:
    """By how much, relative, the sizes of like files differ from their median; None where fewer than half are alike."""
    near = [off for one in sizes if middle > 0 and (off := abs(one / middle - 1)) <= ALIKE]
    return max(near) if 2 * len(near) > len(sizes) else None


def _most(values: Sequence[T]) -> T | None:
    """The value that more than half of the files share; None where there is none, or where there are too few files."""
    if len(values) < FEWEST:
        return None
    value, count = Counter(values).most_common(1)[0]
    return value if 2 * count > len(values) else None


def _all(texts: Iterable[Iterable[str]]) -> list[str]:
    """Every text once, in the order in which it is first there."""
    return list(dict.fromkeys(text for some in texts for text in some))
