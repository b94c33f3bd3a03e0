"""Text of the Turkish network as AFAD wrote it until its DYNA files: labels, a row of names, three columns of 13 characters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Record:
    """Three components of equal length. `header`: values that replace those that follow from the samples, by their label."""

    values: Sequence[Sequence[float]]
    dt: float = 0.01
    names: tuple[str, ...] = ("N-S", "E-W", "U-D")
    header: dict[str, str] = field(default_factory=dict)


def written(record: Record) -> bytes:
    peaks = " ".join(
        f"({name}) {max(abs(one) for one in values):.6f}" for name, values in zip(record.names, record.values, strict=True)
    )
    header = {
        "PLACE": "AYDýN SOKE YENIKENT", "EARTHQUAKE DATE": "2017/07/20 22:31:09 (GMT)",
        "EPICENTER COORDINATES": "36.91980N-27.44350E", "EARTHQUAKE MAGNITUDE": "6.5 Mw", "STATION ID": "0911",
        "STATION COORDINATES": "37.76209N-27.39092E", "RECORD TIME": "20/07/2017 22:31:09.000000 (GMT)",
        "NUMBER OF DATA": f"{len(record.values[0])}", "SAMPLING INTERVAL (sec)": f"{record.dt:g}",
        "RAW PGA VALUES (gal)": peaks,
    } | record.header  # fmt: skip
    lines = ["STRONG GROUND MOTION RECORDS OF TURKIYE", *(f"{key:<24s}: {value}" for key, value in header.items())]
    lines += ["Copyright EARTHQUAKE DEPARTMENT", "DISASTER AND EMERGENCY MANAGEMENT PRESIDENCY"]
    lines.append("".join(f"{name:>13s}" for name in record.names))
    lines += ["".join(f"{one:13.6f}" for one in row) for row in zip(*record.values, strict=True)]
    return ("\r\n".join(lines) + "\r\n").encode("iso-8859-9", "replace")
