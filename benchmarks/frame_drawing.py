"""`frame_step.svg`: time of a step against the bytes that it touches, beside the time to read them, both axes logarithmic."""

from __future__ import annotations

from math import log10
from typing import Any

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 470, 80, 210, 30, 60
X_RANGE, Y_RANGE = (0.0, 3.7), (-2.0, 2.4)  # decades of kB and of microseconds
BEFORE, NOW, LIMIT, OTHER = "#d1242f", "#1f6feb", "#57606a", "#8250df"


def _x(kb: float) -> float:
    return LEFT + (log10(kb) - X_RANGE[0]) / (X_RANGE[1] - X_RANGE[0]) * (WIDTH - LEFT - RIGHT)


def _y(microseconds: float) -> float:
    return HEIGHT - BOTTOM - (log10(microseconds) - Y_RANGE[0]) / (Y_RANGE[1] - Y_RANGE[0]) * (HEIGHT - TOP - BOTTOM)


def _text(x: float, y: float, words: str, anchor: str = "middle", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{words}</text>'


def _line(points: list[tuple[float, float]], colour: str, dashes: str) -> str:
    shown = " ".join(f"{_x(kb):.1f},{_y(us):.1f}" for kb, us in points)
    return f'<polyline points="{shown}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>'


def _dots(rows: list[dict[str, Any]], colour: str, beside: int) -> list[str]:
    parts = []
    for row in rows:
        x, y = _x(row["touched_bytes"] / 1024), _y(row["step_us"])
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>')
        parts.append(_text(x, y + beside, str(row["dof"]), more=f'font-size="11" fill="{colour}"'))
    return parts


def _axes() -> list[str]:
    parts = []
    for kb in (1, 10, 100, 1000):
        parts.append(f'<path d="M{_x(kb):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(_x(kb), HEIGHT - BOTTOM + 20, str(kb)))
    for decade in range(int(Y_RANGE[0]), int(Y_RANGE[1]) + 1):
        parts.append(f'<path d="M{LEFT} {_y(10.0**decade):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, _y(10.0**decade) + 4, f"{10.0**decade:g}", "end"))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 15, "Data that a step touches (kB)"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(_text(22, middle, "Time per step (µs)", more=f'transform="rotate(-90 22 {middle})"'))
    return parts


def svg(found: dict[str, Any]) -> str:
    """Chart of the inelastic frames before and now, by degrees of freedom, and of the limit by memory traffic, as SVG."""
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">']
    parts += [f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', *_axes()]
    limit = [(row["kb"], row["us"]) for row in found["read"] if row["us"] >= 10 ** Y_RANGE[0]]
    edge = WIDTH - RIGHT + 8
    parts.append(_line(limit, LIMIT, "5 4"))
    parts.append(_text(edge, _y(limit[-1][1]) + 4, "reading the data once", "start", f'fill="{LIMIT}"'))
    theirs = found["paper"].get("opensees_us")
    if theirs:
        parts.append(f'<path d="M{LEFT} {_y(theirs):.1f}H{WIDTH - RIGHT}" stroke="{OTHER}" stroke-dasharray="2 3"/>')
        parts.append(_text(edge, _y(theirs) + 4, "OpenSees, 122 DOF", "start", f'fill="{OTHER}"'))
    for key, colour, name in (("before", BEFORE, f"before ({found['commit_before']})"), ("now", NOW, "now")):
        rows = found[key]
        parts.append(_line([(row["touched_bytes"] / 1024, row["step_us"]) for row in rows], colour, "none"))
        parts += _dots(rows, colour, -9 if key == "before" else 19)
        last = rows[-1] if key == "before" else rows[-2]
        parts.append(_text(edge, _y(last["step_us"]) + 4, name, "start", f'fill="{colour}"'))
    parts.append(_text(edge, TOP + 12, "numbers: degrees of freedom", "start", 'font-size="11" fill="#57606a"'))
    return "\n".join([*parts, "</svg>"]) + "\n"
