"""K-NET and KiK-net files as NIED writes them: 17 lines of header, then counts in eight columns of 9 characters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Record:
    """A record of one direction. `header`: values that replace those that follow from the counts, by their label."""

    counts: Sequence[int]
    direction: str = "N-S"
    factor: tuple[int, int] = (3920, 6182761)
    rate: int = 100
    start: str = "2008/06/14 08:44:18"
    header: dict[str, str] = field(default_factory=dict)

    @property
    def gal(self) -> list[float]:
        mean = sum(self.counts) / len(self.counts)
        return [(one - mean) * self.factor[0] / self.factor[1] for one in self.counts]


def written(*records: Record, digits: int = 3) -> bytes:
    lines: list[str] = []
    for one in records:
        header = {
            "Origin Time": "2008/06/14 08:43:00", "Lat.": "39.028", "Long.": "140.880", "Depth. (km)": "8", "Mag.": "7.2",
            "Station Code": "AOM017", "Station Lat.": "40.6363", "Station Long.": "139.9284", "Station Height(m)": "42",
            "Record Time": one.start, "Sampling Freq(Hz)": f"{one.rate}Hz",
            "Duration Time(s)": f"{len(one.counts) / one.rate:g}", "Dir.": one.direction,
            "Scale Factor": f"{one.factor[0]}(gal)/{one.factor[1]}",
            "Max. Acc. (gal)": f"{max(abs(gal) for gal in one.gal):.{digits}f}",
            "Last Correction": "2008/06/14 08:44:03", "Memo.": "",
        } | one.header  # fmt: skip
        lines += [f"{label:<18s}{value}" for label, value in header.items()]
        for start in range(0, len(one.counts), 8):
            lines.append("".join(f"{count:8d} " for count in one.counts[start : start + 8]))
    return ("\n".join(lines) + "\n").encode()
