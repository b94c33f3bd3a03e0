"""A figure of a report drawn as SVG."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.reports.figures import Panel
from app.reports.packed import Samples, unpacked
from app.reports.svg.frame import LINES, Entry, Frame, Size, axes, box, frame, legend, svg, words
from app.reports.svg.maps import cells, rows, tornado
from app.reports.svg.path import FINE, path, thinned
from app.reports.svg.scale import Scale, linear, logarithmic

TICKS_X, TICKS_Y = 80.0, 38.0  # px for each tick at least
BAR = 0.38  # of the distance between bars


@dataclass(frozen=True, slots=True)
class Line:
    """A trace of a panel: name, points and look."""

    name: str
    x: Samples
    y: Samples
    style: str
    bars: bool = False


def plot(panel: Panel, size: Size, points: int, style: str = "") -> str:
    """The figure of a panel, with at most about `points` points for each line. `style`: see `frame.svg`."""
    spec = panel.spec
    if "rows" in spec:
        return svg(size, rows(spec, size), panel.alt, style)
    if "tornado" in spec:
        return svg(size, tornado(spec, size), panel.alt, style)
    if "surface" in spec:
        return svg(size, cells(spec, size), panel.alt, style)
    lines = [_line(trace) for trace in spec["traces"]]
    return svg(size, _lines(spec, lines, size, points), panel.alt, style)


def _lines(spec: dict[str, Any], lines: list[Line], size: Size, points: int) -> list[str]:
    x_values = np.concatenate([one.x for one in lines] or [np.array([])])
    y_values = np.concatenate([one.y for one in lines] or [np.array([])])
    logs, zeros = spec.get("log", ""), spec["from_zero"]
    most_y = max(3, int(size.height / TICKS_Y))
    bars = any(one.bars for one in lines)
    y = logarithmic(y_values, most_y) if "y" in logs else linear(y_values, most_y, from_zero="y" in zeros or bars)
    named = len(lines) > 1
    area = frame(size, [label for _, label in y.ticks], named)
    most_x = max(3, int(area.width / TICKS_X))
    ordered = _forward(lines)
    x = logarithmic(x_values, most_x) if "x" in logs else linear(x_values, most_x, from_zero="x" in zeros, tight=ordered)
    parts = [*_spans(spec.get("spans", []), area, x), *axes(area, x, y, (spec["x"], spec["y"]))]
    barred = [one for one in lines if one.bars]
    for place, one in enumerate(barred):
        parts.append(_bars(one, area, x, y, place, len(barred)))
    shown = [one for one in lines if not one.bars]
    parts += [_path(one, area, x, y, points) for one in shown]
    parts += _marks(spec.get("marks", []), area, x)
    if spec.get("mark"):
        parts += _mark(spec["mark"], area, x, y)
    if named:
        parts += legend(area, [Entry(one.name, f"{one.style} sample") for one in lines])
    return parts


def _line(trace: dict[str, Any]) -> Line:
    wide = " thick" if trace.get("width", 0) > 2 else " thin" if trace.get("thin") else ""
    style = f"l{trace['colour'] % LINES}{wide}{' dash' if trace.get('dash') else ''}"
    return Line(trace["name"], unpacked(trace["x"]), unpacked(trace["y"]), style, bool(trace.get("bars")))


def _forward(lines: list[Line]) -> bool:
    """Whether x is time or another quantity that only grows: its axis then ends with the data."""
    return all(len(one.x) < 2 or bool(np.all(np.diff(np.nan_to_num(one.x)) >= 0)) for one in lines)


def _path(one: Line, area: Frame, x: Scale, y: Scale, points: int) -> str:
    across, up = thinned(one.x, one.y, area.width, points)
    data = path(area.left + x.place(across) * area.width, area.top + (1 - y.place(up)) * area.height)
    return f'<path class="{one.style}" transform="scale({1 / FINE:g})" d="{data}"/>' if data else ""


def _bars(one: Line, area: Frame, x: Scale, y: Scale, place: int, count: int) -> str:
    step = float(np.min(np.diff(one.x))) if len(one.x) > 1 else x.high - x.low
    width = step / (x.high - x.low) * area.width * 2 * BAR / count
    zero = area.y(float(y.place(np.array([0.0]))[0]))
    data = []
    for at, value in zip(x.place(one.x), y.place(one.y), strict=True):
        if np.isfinite(value):
            left = area.x(float(at)) + (place - count / 2) * width
            data.append(f"M{left:.1f} {zero:.1f}V{area.y(float(value)):.1f}h{width:.1f}V{zero:.1f}")
    return f'<path class="bar {one.style}" d="{"".join(data)}"/>'


def _spans(spans: list[dict[str, Any]], area: Frame, x: Scale) -> list[str]:
    parts = []
    for one in spans:
        first, last = np.clip(x.place(np.array([one["from"], one["to"]])), 0, 1).tolist()
        if last > first:
            parts.append(box("sh", area.x(first), area.top, (last - first) * area.width, area.height))
            if (last - first) * area.width > area.size.long(one["text"]):
                parts.append(words(area.x((first + last) / 2), area.top + area.size.text, one["text"], "no"))
    return parts


def _marks(marks: list[dict[str, Any]], area: Frame, x: Scale) -> list[str]:
    """Numbered annotations: a line at a time, or a band over a span; the number stands in a flag at its head."""
    parts, text = [], area.size.text
    for one in marks:
        first, last = np.clip(x.place(np.array([one["from"], one.get("to") or one["from"]])), 0, 1).tolist()
        inside = x.low <= one["from"] <= x.high or x.low <= (one.get("to") or one["from"]) <= x.high
        if not inside and not (one["from"] < x.low and (one.get("to") or one["from"]) > x.high):
            continue
        at, label = area.x(first), one["text"]
        kind = "trip" if one.get("trip") else "note"
        if last > first:
            parts.append(box("span", at, area.top, (last - first) * area.width, area.height))
        parts.append(f'<path class="{kind}" d="M{at:.1f} {area.top:.1f}V{area.y(0):.1f}"/>')
        width = 0.6 * text + area.size.long(label)
        left = min(max(at - width / 2, area.left), area.x(1) - width)
        parts.append(box(f"flag {kind}", left, area.top, width, 1.2 * text))
        parts.append(words(left + width / 2, area.top + 0.95 * text, label, "fl"))
    return parts


def _mark(mark: dict[str, Any], area: Frame, x: Scale, y: Scale) -> list[str]:
    across, up = area.x(float(x.place(np.array([mark["x"]]))[0])), area.y(float(y.place(np.array([mark["y"]]))[0]))
    right = across + area.size.long(mark["text"]) > area.x(1)
    anchor = "end" if right else "start"
    beside = -6 if right else 6
    dot = f'<circle class="mk" cx="{across:.1f}" cy="{up:.1f}" r="3.5"/>'
    return [dot, words(across + beside, up - 5, mark["text"], "tk", anchor)]
