"""What one line of a header states. The lines are plain text: lower case, without accents."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rths_engine.formats.plain import header_words as words
from rths_engine.formats.statement import Written, last_digit

# chosen; see docs/decisions/0023
LONGEST_UNSTATED = 0.1  # s: a longer step without a unit can be in ms; a shorter one in ms would be above 10 kHz

_SCALES = {"us": 1e-6, "ms": 1e-3, "mi": 60.0, "h": 3600.0, "s": 1.0}  # seconds, by definition


@dataclass(frozen=True, slots=True)
class Peak:
    """A peak in the header: of a component (empty: of the record), with its unit and its time (s) where they are stated."""

    value: Written
    unit: str = ""
    component: str = ""
    quantity: str = ""
    time: Written | None = None
    least: bool = False


_NUMBER = rf"(?P<v>{words.NUMBER})"
_BEFORE = r"(?<![a-z0-9_])"
_IN, _END = r"(?:(?:\s*|(?P<apart>\s*[,;\t]\s*))", r"(?(apart)(?=\s*(?:$|[,;\t]))))?"  # a unit can be a field of its own
_GROUPED = re.compile(r"[1-9]\d{0,2},\d{3}")
_COUNT = re.compile(rf"{_BEFORE}(?:{words.COUNT}){words.BRACKET}{words.IS}{_NUMBER}(?!\s*(?:s|sec|hz)\b)")
_COUNT_FIRST = re.compile(rf"(?<![\w.,-])(?P<v>\d[\d.,'\u2019]*)\s+(?:{words.COUNT_AFTER})")
_RATE = re.compile(rf"{_BEFORE}(?P<label>{words.RATE}){words.BRACKET}{words.IS}{_NUMBER}{_IN}(?P<unit>{words.RATE_UNIT}){_END}")
_RATE_FIRST = re.compile(
    rf"(?:{words.RATE_BEFORE}|@\s*){_NUMBER}\s*(?P<unit>{words.RATE_UNIT})"
    rf"|(?<![\w*^.,/-])(?P<n>{words.NUMBER})\s*(?P<u>{words.PER_SECOND}|{words.PER_LONGER}|k?sps\b)(?!\s*[:=])"
)
_OTHER_RATE_UNIT = re.compile(words.OTHER_RATE_UNIT)
_STEP = re.compile(rf"{_BEFORE}(?:{words.STEP}){words.BRACKET}{words.IS}{_NUMBER}{_IN}(?P<unit>{words.TIME_UNIT}){_END}")
_STEP_UNIT = re.compile(rf"(?:{words.STEP_WITH_UNIT}{words.IS}|{words.STEP_BEFORE}){_NUMBER}\s*(?P<unit>{words.TIME_UNIT})")
_DURATION = re.compile(
    rf"{_BEFORE}(?P<label>{words.DURATION}){words.BRACKET}{words.IS}{_NUMBER}"
    rf"{_IN}(?P<unit>{words.TIME_UNIT}|samples|points){_END}"
)
PEAK = re.compile(rf"{_BEFORE}(?P<label>{words.PEAK})")
MINIMUM = re.compile(rf"{_BEFORE}(?P<label>{words.MINIMUM})")
_BARE_MINIMUM = re.compile(rf"{_BEFORE}(?P<label>{words.BARE_MINIMUM})")
_PEAK_VALUE = re.compile(
    rf"\s*(?P<component>{words.COMPONENT})?{words.BRACKET}{words.IS}{_NUMBER}\s*[(\[]?\s*(?P<unit>[a-z%][a-z/^*\d.-]*)?"
)
_OF_COMPONENT = re.compile(rf"[(\[]?(?<![a-z])(?P<component>{words.COMPONENT})(?![a-z])[)\]]?\s*[:=]?\s*{_NUMBER}")
_AT_TIME = re.compile(rf"(?:\b(?:at|bei|a|t|time)\b|@)\s*[:=]?\s*(?:t\s*=\s*)?{_NUMBER}\s*(?P<unit>{words.TIME_UNIT})")
_PEAK_TIME = re.compile(rf"(?:{words.PEAK_TIME}){words.BRACKET}{words.IS}{_NUMBER}\s*(?P<unit>{words.TIME_UNIT})?")
_MISSING = re.compile(rf"{_BEFORE}(?:{words.MISSING}){words.BRACKET}(?:{words.IS}|\s*(?:as|als|par|como)\s*){_NUMBER}")
_MISSING_FIRST = re.compile(
    rf"{_NUMBER}\s*(?:[:=]|means|is|denotes|indicates|marks|bedeutet|steht\s+fur|signifie|significa)?\s*(?:{words.MISSING})"
)
_CHANNELS = re.compile(rf"{_BEFORE}(?:{words.CHANNELS}){words.IS}{_NUMBER}")
_COMPONENTS = re.compile(rf"{_BEFORE}{words.COMPONENTS}(?=[a-z])(.+)")
_FORTRAN = re.compile(r"[(\[]\s*\d*\s*(?:\d+p,?)?\s*\d*[feg](\d+)\.\d+\s*[)\]]")


def written(text: str, where: str, scale: float = 1.0) -> Written:
    """The number in a line, in the unit of which one is `scale`."""
    point = text if "." in text and "," not in text else text.replace(",", "" if "." in text else ".")
    return Written(words.number(text) * scale, last_digit(re.sub("['\u2019\u00a0\u202f]", "", point)) / 2 * scale, where)


def counts(text: str, where: str) -> Iterator[Written]:
    """The stated count of samples."""
    for match in (*_COUNT.finditer(text), *_COUNT_FIRST.finditer(text)):
        if (count := words.whole(match["v"].rstrip(".,"))) is not None:
            yield Written(count, 0.0, where)
            return


def steps(text: str, where: str) -> tuple[list[Written], list[str]]:
    """The steps (s) in a line, and the statements whose unit is neither stated nor clear."""
    found: list[Written] = []
    unclear: list[str] = []
    for match in _RATE.finditer(text):
        value = words.number(match["v"])
        unit = match["unit"] or match["bracket"] or (match["label"] if re.search(words.PER_LONGER, match["label"]) else "")
        if _GROUPED.fullmatch(match["v"]):
            unclear.append(f"{where} states a rate of {match['v']}, which can be {value:g} or {match['v'].replace(',', '')}")
            continue
        if not match["unit"] and (other := _OTHER_RATE_UNIT.match(text, match.end("v"))):
            unclear.append(f"{where} states a rate of {value:g} in the unknown unit '{other[0].strip()}'")
            continue
        if value <= 0 or (not match["unit"] and unit and not re.search(words.RATE_UNIT, unit)):
            continue
        if not unit and re.search(words.PER_SECOND, match["label"]):
            unit = "hz"
        if not unit and value < 1 / LONGEST_UNSTATED:
            unclear.append(f"{where} states a rate of {value:g} without a unit")
            continue
        found.append(_step_of_rate(match["v"], unit, where))
    if not found and not unclear:
        found += [_step_of_rate(one["v"] or one["n"], one["unit"] or one["u"], where) for one in _RATE_FIRST.finditer(text)]
    for match in (*_STEP.finditer(text), *_STEP_UNIT.finditer(text)):
        unit = match["unit"] or match.groupdict().get("bracket") or ""
        if not match["unit"] and unit and not re.fullmatch(words.TIME_UNIT, unit):
            continue
        value = words.number(match["v"])
        if value <= 0:
            continue
        if not unit and value > LONGEST_UNSTATED:
            unclear.append(f"{where} states a step of {value:g} without a unit")
            continue
        found.append(written(match["v"], where, scale(unit)))
    return found, unclear


def decimation(text: str) -> str:
    """The statement that only every n-th sample was kept; empty where the line has none."""
    found = words.DECIMATED.search(text)
    return found[0].strip() if found and words.number(found["v"] or found["e"]) != 1 else ""


def _step_of_rate(text: str, unit: str, where: str) -> Written:
    scale = 1e3 if unit.startswith("k") else 1.0
    if re.search(words.PER_LONGER, unit):
        scale = 1 / 3600 if re.search(words.PER_HOUR, unit) else 1 / 60
    rate = written(text, where, scale)
    return Written(1 / rate.value, rate.within / rate.value**2, where)


def scale(unit: str) -> float:
    """Seconds in one unit of time as headers write it."""
    plain = "us" if unit[:1] in {"u", "\u00b5", "\u03bc"} else "ms" if unit.startswith(("ms", "milli")) else unit
    return next((scale for start, scale in _SCALES.items() if plain.startswith(start)), 1.0)


def durations(text: str, where: str) -> Iterator[tuple[Written, bool]]:
    """The stated durations (s), and whether the line states their unit."""
    if words.OTHER_DURATION.search(text):
        return
    for match in _DURATION.finditer(text):
        unit = match["unit"] or match["bracket"] or ""
        timed = bool(re.fullmatch(words.TIME_UNIT, unit))
        if timed or (not unit and "length" not in match["label"]):
            yield written(match["v"], where, scale(unit) if timed else 1.0), timed


def with_peaks(peaks: list[Peak], text: str, where: str) -> list[Peak]:
    """The peaks so far and those in the line; a line with the time of the peak completes the last of them."""
    if found := _PEAK_TIME.search(text):
        alone = written(found["v"], where, scale(found["unit"] or found["bracket"] or ""))
        last = peaks[-1] if peaks else Peak(Written(float("nan"), 0.0, where))
        return [*peaks[:-1], Peak(last.value, last.unit, last.component, last.quantity, alone)]
    if words.OTHER_PEAK.search(text):
        return peaks
    return [*peaks, *_peaks(text, where)]


def _peaks(text: str, where: str) -> Iterator[Peak]:
    """The largest and smallest values in a line."""
    highest, lowest = list(PEAK.finditer(text)), list(MINIMUM.finditer(text))
    if highest and not lowest:
        lowest = list(_BARE_MINIMUM.finditer(text))
    labels = sorted([*((one, False) for one in highest), *((one, True) for one in lowest)], key=lambda pair: pair[0].start())
    for k, (label, least) in enumerate(labels):
        end = labels[k + 1][0].start() if k + 1 < len(labels) else len(text)
        if label.end() <= end:
            yield from _after(label, text[:end], where, least)


def _after(label: re.Match[str], text: str, where: str, least: bool) -> Iterator[Peak]:
    """The values behind a label: one, or one for each component."""
    rest = text[label.end() :]
    quantity = _quantity(label["label"], text)
    several = list(_OF_COMPONENT.finditer(rest))
    one = _PEAK_VALUE.match(rest)
    bracket = re.match(r"\s*[(\[]\s*([^)\]]+?)\s*[)\]]", rest)
    common = bracket[1] if bracket and not re.fullmatch(words.COMPONENT, bracket[1]) else ""
    if len(several) > 1:
        for each in several:
            yield Peak(written(each["v"], where), common, each["component"], quantity, least=least)
        return
    if one is None:
        return
    inside = one["bracket"] or ""
    component = one["component"] or (inside if re.fullmatch(words.COMPONENT, inside) else "")
    unit = common or (one["unit"] or "").rstrip(".")
    timed = _AT_TIME.search(rest, one.end("v"))
    time = written(timed["v"], where, scale(timed["unit"])) if timed else None
    if unit in {"at", "sec", "s"}:
        unit = ""
    yield Peak(written(one["v"], where), unit, component, quantity, time, least)


def _quantity(label: str, text: str) -> str:
    if re.search(words.OF_ACCELERATION, label):
        return "acceleration"
    return next((quantity for quantity, sign in words.OF_QUANTITY if re.search(sign, label)), "") or next(
        (quantity for quantity, sign in words.OF_QUANTITY[:2] if re.search(sign, text)), ""
    )


def missing(text: str, where: str) -> Iterator[Written]:
    """The stated marks of missing values."""
    for match in (*_MISSING.finditer(text), *_MISSING_FIRST.finditer(text)):
        yield written(match["v"], where)


def channels(text: str, where: str) -> list[Written]:
    """The stated numbers of channels."""
    return [written(match["v"], where) for match in _CHANNELS.finditer(text)]


def components(text: str) -> tuple[str, ...]:
    """The components that the line lists."""
    listed = _COMPONENTS.search(text)
    return tuple(re.findall(r"[^\s,;/|]+", listed[1])) if listed else ()


def factor(text: str) -> str:
    """The factor that the line states for the values; empty where it states none, or one."""
    found = words.FACTOR.search(text)
    return found[0].strip() if found and words.number(found["v"]) != 1 and not words.OTHER_FACTOR.search(text) else ""


def width(text: str) -> int:
    """The width of a field in a Fortran format such as (8F10.4); 0 where the line has none."""
    form = _FORTRAN.search(text)
    return int(form[1]) if form else 0
