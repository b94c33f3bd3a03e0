"""Pictures of a proof as SVG: rates by class of lambda, and the reliability of probabilities, with Wilson 95 % intervals."""

from __future__ import annotations

from typing import Any

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 360, 60, 200, 24, 56
APART = 16  # between the points of a class
DRAWN = {
    "located_rate": ("component located", "#1f6feb"),
    "named_first_rate": ("effect named first", "#d1242f"),
    "named_top3_rate": ("among the first three", "#bf8700"),
    "oracle_named_first_rate": ("oracle names first", "#656d76"),
}


def svg(result: dict[str, Any]) -> str:
    classes = [name for name in result["located_rate"] if name != "all"]
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
    ]
    for percent in range(0, 101, 20):
        parts.append(f'<path d="M{LEFT} {_y(percent / 100):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, _y(percent / 100) + 4, f"{percent} %", "end"))
    for place, name in enumerate(classes):
        parts.append(_text(_x(place, len(classes)), HEIGHT - BOTTOM + 20, name.replace(">=", "≥ ").replace("<", "&lt; ")))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, "λ of what is concealed"))
    for number, (key, (words, colour)) in enumerate(DRAWN.items()):
        for place, name in enumerate(classes):
            if result[key][name]["count"]:
                parts += _rate(_x(place, len(classes)) + APART * (number - (len(DRAWN) - 1) / 2), result[key][name], colour)
        parts.append(f'<circle cx="{WIDTH - RIGHT + 20}" cy="{TOP + 10 + 22 * number}" r="4" fill="{colour}"/>')
        parts.append(_text(WIDTH - RIGHT + 32, TOP + 14 + 22 * number, words, "start"))
    return "\n".join([*parts, "</svg>"]) + "\n"


def reliability(result: dict[str, Any]) -> str:
    """The share of the named effects that is right, against their probability."""
    side = HEIGHT - TOP - BOTTOM
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + side + 160} {HEIGHT}" font-family="sans-serif" '
        'font-size="13">',
        f'<rect width="{LEFT + side + 160}" height="{HEIGHT}" fill="white"/>',
        f'<path d="M{LEFT} {_y(0):.1f}L{LEFT + side} {_y(1):.1f}" stroke="#656d76" stroke-dasharray="4 4"/>',
    ]
    for percent in range(0, 101, 20):
        parts.append(f'<path d="M{LEFT} {_y(percent / 100):.1f}h{side}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, _y(percent / 100) + 4, f"{percent} %", "end"))
        parts.append(_text(LEFT + side * percent / 100, HEIGHT - BOTTOM + 20, f"{percent / 100:.1f}"))
    for tenth in result["reliability"]:
        if tenth["count"]:
            x = LEFT + side * tenth["probability"]
            parts += _rate(x, tenth, "#1f6feb")
            parts.append(_text(x + 7, _y(tenth["value"]) + 4, str(tenth["count"]), "start"))
    parts.append(_text(LEFT + side / 2, HEIGHT - 12, "probability of a named effect"))
    parts.append(_text(LEFT + side + 12, TOP + 14, "share that is right,", "start"))
    parts.append(_text(LEFT + side + 12, TOP + 32, "with its count", "start"))
    return "\n".join([*parts, "</svg>"]) + "\n"


def _rate(x: float, rate: dict[str, Any], colour: str) -> list[str]:
    low, high = rate["wilson95"]
    return [
        f'<path d="M{x:.1f} {_y(low):.1f}V{_y(high):.1f}" stroke="{colour}" stroke-width="2"/>',
        f'<circle cx="{x:.1f}" cy="{_y(rate["value"]):.1f}" r="4" fill="{colour}"/>',
    ]


def _x(place: int, count: int) -> float:
    return LEFT + (place + 0.5) / count * (WIDTH - LEFT - RIGHT)


def _y(share: float) -> float:
    return HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)


def _text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'
