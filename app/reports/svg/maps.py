"""Maps as SVG: rows of levels over time, cells over two quantities, and bars about a centre."""

from __future__ import annotations

from itertools import groupby
from typing import Any

import numpy as np

from app.reports.digits import short
from app.reports.svg.frame import Entry, Frame, Size, axes, box, legend, words
from app.reports.svg.scale import Scale, linear

LEVELS = 8  # shades of the map of levels: classes h0 to h7
ROW_GAP = 5.0  # px between rows
BAR = 11.0  # px, width of the scale beside a map
SPLIT = (" of ", " in ")  # a long name of a row breaks here


def rows(spec: dict[str, Any], size: Size) -> list[str]:
    """A row of shades for each component over time, with its scale at the right."""
    names = [_two_lines(row["name"]) for row in spec["rows"]]
    longest = max((size.long(part) for name in names for part in name), default=0.0)
    area = Frame(size, longest + 14, 5.5 * size.text + BAR, 0.6 * size.text, 2.9 * size.text)
    times = np.concatenate([np.asarray(row["x"], dtype=float) for row in spec["rows"]] or [np.array([])])
    x = linear(times, max(3, int(area.width / 80)), tight=True)
    empty = Scale(0.0, 1.0, ())
    parts, height = axes(area, x, empty, (spec["x"], ""), labels=False), area.height / max(1, len(spec["rows"]))
    for number, (row, name) in enumerate(zip(spec["rows"], names, strict=True)):
        top = area.top + number * height + ROW_GAP / 2
        parts += _row(row, spec["scale"], area, x, top, height - ROW_GAP)
        first = top + (height - ROW_GAP) / 2 + (0.35 if len(name) == 1 else -0.2) * size.text
        parts += [words(area.left - 7, first + one * 1.1 * size.text, part, "tk", "end") for one, part in enumerate(name)]
    return parts + _shades(spec["scale"], area)


def cells(spec: dict[str, Any], size: Size) -> list[str]:
    """A cell for each pair of values; the shade is the share of the largest magnitude, its kind the sign."""
    surface = spec["surface"]
    across, up = np.asarray(surface["x"], dtype=float), np.asarray(surface["y"], dtype=float)
    scale = _each if surface.get("each") else _cell_scale
    x, y = scale(across, int(size.width / 90)), scale(up, int(size.height / 40))
    left = max((size.long(label) for _, label in y.ticks), default=size.text) + 1.7 * size.text + 7
    area = Frame(size, left, 6.5 * size.text + BAR, 0.8 * size.text, 2.9 * size.text)
    parts = axes(area, x, y, (spec["x"], spec["y"]))
    wide, high = area.width / max(1, len(across)), area.height / max(1, len(up))
    for row, values in enumerate(surface["z"]):
        for column, value in enumerate(values):
            if value is not None:
                shade = f' fill-opacity="{max(0.06, min(1.0, abs(value) / surface["limit"])):.2f}"'
                corner = area.left + column * wide, area.y(0) - (row + 1) * high
                parts.append(box("sn" if value < 0 else "sp", *corner, wide - 0.6, high - 0.6, shade))
    return parts + _signed(surface, area)


def tornado(spec: dict[str, Any], size: Size) -> list[str]:
    """A bar for each input: from the centre to the result at its low end and at its high end."""
    rows, centre = spec["tornado"]["rows"], spec["tornado"]["centre"]
    longest = max(size.long(row["name"]) for row in rows)
    area = Frame(size, min(longest + 14, size.width / 2), 14, 2.0 * size.text, 2.9 * size.text)
    x = linear(np.array([centre, *(row[end] for row in rows for end in ("low", "high"))]), max(3, int(area.width / 90)))
    parts, height = axes(area, x, Scale(0.0, 1.0, ()), (spec["x"], ""), labels=False), area.height / len(rows)
    middle, low, high = (
        [area.x(float(place)) for place in x.place(np.array(values))]
        for values in ([centre], [row["low"] for row in rows], [row["high"] for row in rows])
    )
    for number, row in enumerate(rows):
        top = area.top + number * height + ROW_GAP
        for style, end in (("sn", low[number]), ("sp", high[number])):
            parts.append(
                box(style, min(middle[0], end), top, abs(end - middle[0]), height - 2 * ROW_GAP, ' fill-opacity="0.75"')
            )
        parts.append(words(area.left - 7, top + height / 2 - ROW_GAP + 0.35 * size.text, row["name"], "tk", "end"))
    parts.append(f'<path class="ax" d="M{middle[0]:.1f} {area.top:.1f}V{area.y(0):.1f}"/>')
    return parts + legend(area, [Entry("lowest third", "l0 sample"), Entry("highest third", "l1 sample")])


def _row(row: dict[str, Any], scale: dict[str, Any], area: Frame, x: Scale, top: float, height: float) -> list[str]:
    times = np.asarray(row["x"], dtype=float)
    step = float(times[1] - times[0]) if len(times) > 1 else x.high - x.low
    shades = np.clip((np.asarray(row["z"], dtype=float) - scale["from"]) / (scale["to"] - scale["from"]), 0, 1) * (LEVELS - 1)
    parts = []
    for shade, group in groupby(enumerate(np.round(shades).astype(int).tolist()), key=lambda one: one[1]):
        numbers = [number for number, _ in group]
        ends = x.place(np.array([times[numbers[0]] - step / 2, times[numbers[-1]] + step / 2]))
        first, last = np.clip(ends, 0, 1).tolist()
        parts.append(box(f"h{shade}", area.x(first), top, (last - first) * area.width, height))
    return parts


def _shades(scale: dict[str, Any], area: Frame) -> list[str]:
    """The scale of a map of levels."""
    left, each = area.x(1) + 12, area.height / LEVELS
    parts = [box(f"h{shade}", left, area.y(0) - (shade + 1) * each, BAR, each + 0.3) for shade in range(LEVELS)]
    for at, said in zip(scale["at"], scale["said"], strict=True):
        place = (at - scale["from"]) / (scale["to"] - scale["from"])
        parts.append(words(left + BAR + 4, area.y(place) + 0.35 * area.size.text, said, "tk", "start"))
    return [*parts, *_turned(scale["title"], area)]


def _signed(surface: dict[str, Any], area: Frame) -> list[str]:
    """The scale of a map of cells: from the negative to the positive limit."""
    left, parts, steps = area.x(1) + 12, [], 10
    each = area.height / (2 * steps)
    for step in range(-steps, steps):
        share = (step + 0.5) / steps
        opacity = f' fill-opacity="{abs(share):.2f}"'
        parts.append(box("sn" if share < 0 else "sp", left, area.y(0.5) - (step + 1) * each, BAR, each + 0.3, opacity))
    for place, value in ((0.0, -surface["limit"]), (0.5, 0.0), (1.0, surface["limit"])):
        said = f"{value:.3g}".replace("-", "−")
        parts.append(words(left + BAR + 4, area.y(place) + 0.35 * area.size.text, said, "tk", "start"))
    return [*parts, *_turned(surface["title"], area)]


def _turned(title: str, area: Frame) -> list[str]:
    across, middle = area.size.width - 0.4 * area.size.text, area.y(0.5)
    return [words(across, middle, title, "ti", "middle", f' transform="rotate(-90 {across:.1f} {middle:.1f})"')]


def _cell_scale(middles: np.ndarray[Any, Any], most: int) -> Scale:
    """A scale whose ends are the outer edges of equal cells."""
    half = (middles[1] - middles[0]) / 2 if len(middles) > 1 else 0.5
    ends = np.array([middles[0] - half, middles[-1] + half]) if len(middles) else np.array([0.0, 1.0])
    return linear(ends, max(3, most), tight=True)


def _each(middles: np.ndarray[Any, Any], most: int) -> Scale:
    """A scale of cells whose values are not equally spaced: a label below each cell, or below every second, third ... one."""
    every = max(1, -(-len(middles) // max(1, most)))
    ticks = tuple((number + 0.5, short(float(middles[number]), 3)) for number in range(0, len(middles), every))
    return Scale(0.0, float(max(1, len(middles))), ticks)


def _two_lines(name: str) -> list[str]:
    for split in SPLIT:
        if split in name:
            first, _, rest = name.partition(split)
            return [first, f"{split.strip()} {rest}"]
    return [name]
