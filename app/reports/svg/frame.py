"""The frame of a figure: its size, its axes with ticks, grid and titles, and its legend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from app.reports.svg.scale import Scale

TICK, GAP = 4.0, 3.0  # px
LINES = 4  # classes of lines, as many as the palette has colours


@dataclass(frozen=True, slots=True)
class Size:
    """Width and height of a figure and the size of its text, px. `em` is the mean width of a character over that size."""

    width: float
    height: float
    text: float = 12.0
    em: float = 0.6  # of a sans serif on a screen

    def long(self, said: str) -> float:
        """The width of a line of text, px."""
        return len(said) * self.em * self.text


@dataclass(frozen=True, slots=True)
class Entry:
    """A name in the legend. `style` holds the classes of its line."""

    name: str
    style: str


@dataclass(frozen=True, slots=True)
class Frame:
    """The area of the plot inside a figure, px: places 0 to 1 become `x(place)` and `y(place)`."""

    size: Size
    left: float
    right: float
    top: float
    bottom: float

    @property
    def width(self) -> float:
        return self.size.width - self.left - self.right

    @property
    def height(self) -> float:
        return self.size.height - self.top - self.bottom

    def x(self, place: float) -> float:
        return self.left + place * self.width

    def y(self, place: float) -> float:
        return self.top + (1 - place) * self.height


def frame(size: Size, labels: Sequence[str], named: bool, right: float = 10.0) -> Frame:
    """A frame with room for the tick labels of the y axis, and for a legend where lines are `named`."""
    widest = max(map(size.long, labels), default=size.text)
    left = size.text * 1.7 + widest + TICK + GAP
    top = size.text * (1.7 if named else 0.8)
    return Frame(size, left, right, top, size.text * 2.9)


def axes(area: Frame, x: Scale, y: Scale, titles: tuple[str, str], labels: bool = True) -> list[str]:
    """Grid, ticks, tick labels and titles. Without `labels`, the y axis has none of its own."""
    text = area.size.text
    right, foot = area.x(1), area.y(0)
    parts = [f'<path class="gr" d="{_grid(area, x, y, labels)}"/>']
    if not x.log and x.low < 0 < x.high:
        parts.append(f'<path class="ze" d="M{area.x(_place(x, 0.0)):.1f} {area.top:.1f}V{foot:.1f}"/>')
    if labels and not y.log and y.low < 0 < y.high:
        parts.append(f'<path class="ze" d="M{area.left:.1f} {area.y(_place(y, 0.0)):.1f}H{right:.1f}"/>')
    parts.append(f'<path class="ax" d="M{area.left:.1f} {area.top:.1f}V{foot:.1f}H{right:.1f}"/>')
    for value, label in x.ticks:
        at = area.x(_place(x, value))
        anchor = "end" if at > right - area.size.long(label) / 2 and right - at < 2 else "middle"
        parts.append(words(at, foot + TICK + text, label, "tk", anchor))
    if labels:
        for value, label in y.ticks:
            at = area.y(_place(y, value))
            parts.append(words(area.left - TICK - GAP, at + 0.35 * text, label, "tk", "end"))
    parts.append(words(area.x(0.5), area.size.height - 0.35 * text, with_power(titles[0], x.power), "ti"))
    if titles[1]:
        middle = area.y(0.5)
        turned = f' transform="rotate(-90 {text:.1f} {middle:.1f})"'
        parts.append(words(text, middle, with_power(titles[1], y.power), "ti", "middle", turned))
    return parts


def legend(area: Frame, entries: Sequence[Entry]) -> list[str]:
    """The names of the lines above the plot, from the right; each follows a stretch of its line."""
    text, parts = area.size.text, []
    at = area.x(1) - sum(area.size.long(one.name) + 3.1 * text for one in entries)
    for entry in entries:
        at += 0.9 * text
        parts.append(f'<path class="{entry.style}" d="M{at:.1f} {0.65 * text:.1f}h{1.7 * text:.1f}"/>')
        at += 2.2 * text
        parts.append(words(at, text, entry.name, "tk", "start"))
        at += area.size.long(entry.name)
    return parts


def words(x: float, y: float, said: str, style: str, anchor: str = "middle", more: str = "") -> str:
    """A line of text at a place, px."""
    return f'<text class="{style}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(said)}</text>'


def box(style: str, x: float, y: float, width: float, height: float, more: str = "") -> str:
    """A rectangle at a place, px."""
    return f'<rect class="{style}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"{more}/>'


def with_power(title: str, power: str) -> str:
    """An axis title with the power of ten of its tick labels."""
    return f"{title} ({power})" if power else title


def svg(size: Size, parts: Sequence[str], alt: str, style: str = "") -> str:
    """A whole figure. `style` is a style sheet, for a drawing that stands alone."""
    sheet = f"<style>{style}</style>" if style else ""
    said = f' role="img" aria-label="{escape(alt)}"' if not style else ""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size.width:g} {size.height:g}" font-size="{size.text:g}"'
    return f"{head}{said}>{sheet}{''.join(parts)}</svg>"


def _grid(area: Frame, x: Scale, y: Scale, labels: bool) -> str:
    across = [f"M{area.x(_place(x, value)):.1f} {area.top:.1f}V{area.y(0) + TICK:.1f}" for value, _ in x.ticks]
    along = [f"M{area.left - TICK:.1f} {area.y(_place(y, value)):.1f}H{area.x(1):.1f}" for value, _ in y.ticks]
    return "".join(across + (along if labels else []))


def _place(scale: Scale, value: float) -> float:
    return float(scale.place(np.array([value]))[0])
