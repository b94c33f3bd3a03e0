"""Text of the Taiwanese network: lines `#Key: value`, then time and three components in columns of 10 characters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Record:
    """Components U, N, E. `header`: values that replace those that follow from the samples, by their key."""

    values: Sequence[Sequence[float]]
    rate: int = 100
    header: dict[str, str] = field(default_factory=dict)
    times: Sequence[float] | None = None


def written(record: Record) -> bytes:
    samples = len(record.values[0])
    ranges = {
        f"AmplitudeMAX. {name}": f"{max(values):8.3f}~ {min(values):8.3f}"
        for name, values in zip("UNE", record.values, strict=True)
    }
    header = {
        "Origin Time(GMT+08)": "2021/04/18-22:11:39", "Magnitude(Ml)": "5.8", "StationCode": "ANP",
        "StationName": "Yangmingshan", "StartTime(GMT+08)": "2021/04/18-22:11:30.000",
        "RecordLength(sec)": f"{samples / record.rate:g}", "SampleRate(Hz)": f"{record.rate}",
        "AmplitudeUnit": " gal. DCoffset(corr)", **ranges, "DataSequence": "Time U(+); N(+); E(+)", "Data": "4F10.3 ",
    } | record.header  # fmt: skip
    lines = ["#Earthquake Information", *(f"#{key}: {value}" for key, value in header.items())]
    lines.insert(4, "")
    times = record.times or [k / record.rate for k in range(samples)]
    lines += ["".join(f"{one:10.3f}" for one in row) for row in zip(times, *record.values, strict=True)]
    return ("\r\n".join(lines) + "\r\n").encode()
