"""Campbell TOA5: four quoted lines, then rows of date, record and values."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta


def written(names: Sequence[str], units: Sequence[str], rows: Sequence[Sequence[float | str]], step: float = 0.05) -> bytes:
    def quoted(fields: Sequence[str]) -> str:
        return ",".join(f'"{one}"' for one in fields)

    lines = [
        quoted(["TOA5", "Bridge", "CR6", "1234", "CR6.Std.10", "CPU:bridge.CR6", "46595", "Fast"]),
        quoted(["TIMESTAMP", "RECORD", *names]),
        quoted(["TS", "RN", *units]),
        quoted(["", "", *["Smp"] * len(names)]),
    ]
    for k, row in enumerate(rows):
        at = datetime(2024, 2, 28, 23, 59, 59) + timedelta(seconds=k * step)
        fraction = f".{at.microsecond // 1000:03d}".rstrip("0").rstrip(".")
        values = [f'"{one}"' if isinstance(one, str) else f"{one:.7g}" for one in row]
        lines.append(",".join([f'"{at:%Y-%m-%d %H:%M:%S}{fraction}"', str(k), *values]))
    return "\r\n".join(lines).encode()
