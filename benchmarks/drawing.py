"""`cost_by_dof.svg`: time per step against degrees of freedom, both axes logarithmic."""

from __future__ import annotations

from math import log10
from typing import Any

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 720, 460, 80, 190, 30, 60
X_RANGE, Y_RANGE = (1.0, 3.4), (-3.0, 3.0)  # decades of DOF and of microseconds
COLOURS = {"elastic frame": "#1f6feb", "inelastic frame": "#d1242f"}


def _x(dof: float) -> float:
    return LEFT + (log10(dof) - X_RANGE[0]) / (X_RANGE[1] - X_RANGE[0]) * (WIDTH - LEFT - RIGHT)


def _y(microseconds: float) -> float:
    return HEIGHT - BOTTOM - (log10(microseconds) - Y_RANGE[0]) / (Y_RANGE[1] - Y_RANGE[0]) * (HEIGHT - TOP - BOTTOM)


def _text(x: float, y: float, words: str, anchor: str = "middle", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{words}</text>'


def _line(rows: list[dict[str, Any]], key: str, colour: str, dashes: str) -> str:
    points = " ".join(f"{_x(row['dof']):.1f},{_y(row[key]):.1f}" for row in rows)
    return f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>'


def svg(rows: list[dict[str, Any]]) -> str:
    """Chart of the time of a step against degrees of freedom, as SVG."""
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">']
    parts.append(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>')
    for dof in (10, 30, 100, 300, 1000, 2000):
        parts.append(f'<path d="M{_x(dof):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(_x(dof), HEIGHT - BOTTOM + 20, str(dof)))
    for decade in range(int(Y_RANGE[0]), int(Y_RANGE[1]) + 1):
        parts.append(f'<path d="M{LEFT} {_y(10.0**decade):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, _y(10.0**decade) + 4, f"{10.0**decade:g}", "end"))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 15, "Degrees of freedom"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(_text(22, middle, "Time per step (µs)", more=f'transform="rotate(-90 22 {middle})"'))
    for kind, colour in COLOURS.items():
        own = [row for row in rows if row["structure"] == kind]
        for key, dashes, name in (("step_us", "none", kind), ("read_us", "5 4", "reading its tables")):
            parts.append(_line(own, key, colour, dashes))
            parts.append(_text(WIDTH - RIGHT + 8, _y(own[-1][key]) + 4, name, "start", f'fill="{colour}"'))
        parts += [f'<circle cx="{_x(row["dof"]):.1f}" cy="{_y(row["step_us"]):.1f}" r="3.5" fill="{colour}"/>' for row in own]
    return "\n".join([*parts, "</svg>"]) + "\n"
