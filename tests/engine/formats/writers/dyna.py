"""DYNA 1.2 text as ESM and AFAD write it: 64 lines `KEY: value`, then one value a line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

PEAKS = {
    "ACCELERATION": ("PGA_CM/S^2", "TIME_PGA_S", "cm/s^2"),
    "VELOCITY": ("PGV_CM/S", "TIME_PGV_S", "cm/s"),
    "DISPLACEMENT": ("PGD_CM", "TIME_PGD_S", "cm"),
}


@dataclass(frozen=True)
class Record:
    """A record. `header`: values that replace those that follow from the samples, by their key."""

    values: Sequence[float]
    dt: float = 0.005
    kind: str = "ACCELERATION"
    header: dict[str, str] = field(default_factory=dict)


def written(record: Record) -> bytes:
    at = max(range(len(record.values)), key=lambda one: abs(record.values[one]))
    peak_key, time_key, unit = PEAKS[record.kind.upper().split()[-1]]
    header = {
        "EVENT_NAME": "GREECE", "EVENT_ID": "EMSC-20190728_0000106", "EVENT_TIME_HHMMSS": "160908", "MAGNITUDE_W": "",
        "NETWORK": "HI", "STATION_CODE": "ARS1", "STATION_NAME": "Town Hall,Argos", "VS30_M/S": "",
        "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "20190728_160919.870",
        "SAMPLING_INTERVAL_S": f"{record.dt:.6f}", "NDATA": f"{len(record.values)}",
        "DURATION_S": f"{len(record.values) * record.dt:.3f}", "STREAM": "HNE", "UNITS": unit,
        peak_key: f"{record.values[at]:.6f}", time_key: f"{at * record.dt:.6f}", "LATE/NORMAL_TRIGGERED": "NT",
        "HEADER_FORMAT": "DYNA 1.2", "DATA_TYPE": record.kind, "PROCESSING": "manual (Paolucci et al., 2011)",
        "USER1": "/home/dyna/processing.py --tr NT: a b", "USER2": "", "USER5": "",
    } | record.header  # fmt: skip
    lines = [f"{key}: {value}" for key, value in header.items()] + [f"{value:.6f}" for value in record.values]
    return ("\n".join(lines) + "\n").encode()
