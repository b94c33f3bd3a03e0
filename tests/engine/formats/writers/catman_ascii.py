"""catman ASCII export: headings `name [unit]`, rows with a tab at their end."""

from __future__ import annotations

from collections.abc import Sequence

Channel = tuple[str, str, Sequence[float]]


def written(groups: Sequence[tuple[str, Sequence[float], Sequence[Channel]]], decimal: str = ".") -> bytes:
    """Groups of a rate: its name, its times and its channels."""
    headings, columns = [], []
    for k, (rate, times, channels) in enumerate(groups, start=1):
        headings += [f"Zeit  {k} - {rate} [s]", *(f"{name} [{unit}]" for name, unit, _ in channels)]
        columns += [times, *(values for *_, values in channels)]
    rows = [
        "".join((f"{one[k]:.6f}".replace(".", decimal) if k < len(one) else "") + "\t" for one in columns)
        for k in range(max(map(len, columns)))
    ]
    return "\r\n".join(["\t".join(headings), *rows, ""]).encode("cp1252")
