"""Scores of many cases by class of lambda, each with its count and its Wilson 95 % interval."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np

CLASSES = {"<10": (0.0, 10.0), "10-25": (10.0, 25.0), "25-100": (25.0, 100.0), ">=100": (100.0, math.inf)}
Row = dict[str, Any]
RATES = {
    "located_rate": "located",
    "named_first_rate": "named_first",
    "named_top3_rate": "named_top3",
    "honest_rate": "honest",
    "oracle_named_first_rate": "oracle_named_first",
    "two_effects_both_rate": "two_both",
    "two_effects_one_rate": "two_one",
    "unknown_rate": "unknown",
    "unknown_misnamed_rate": "misnamed",
    "outside_doubted_rate": "outside_doubted",
    "outside_misnamed_likely_rate": "misnamed_likely",
    "peer_named_first_rate": "peer_named_first",
}
SURE = 0.9
NORMAL = 1.959964  # two-sided 95 %


def wilson(hits: int, count: int) -> list[float] | None:
    """Wilson interval (p + z^2/2n -+ z sqrt(p (1 - p) / n + z^2/4n^2)) / (1 + z^2/n).

    Source: Wilson (1927), J. Am. Stat. Assoc. 22, 209-212.
    """
    if count == 0:
        return None
    p, z2 = hits / count, NORMAL**2
    half = NORMAL * math.sqrt(p * (1 - p) / count + z2 / (4 * count**2))
    middle = p + z2 / (2 * count)
    return [(middle - half) / (1 + z2 / count), (middle + half) / (1 + z2 / count)]


def rate(rows: Iterable[Row], key: str) -> Row:
    hits = [bool(row[key]) for row in rows if row.get(key) is not None]
    return {"value": sum(hits) / len(hits) if hits else None, "count": len(hits), "wilson95": wilson(sum(hits), len(hits))}


def summary(rows: list[Row]) -> Row:
    """The scores of OUT.json. Scores of concealed effects have an entry for each class of lambda and one for `all`."""
    clean = [row for row in rows if row["false_alarm"] is not None]
    found: Row = {"cases": len(rows), "clean_cases": len(clean), "broken": sum(row["verdict"] is None for row in rows)}
    found["false_alarm_rate"], found["falsely_named_rate"] = rate(clean, "false_alarm"), rate(clean, "falsely_named")
    for name, key in RATES.items():
        found[name] = by_class(rows, partial(rate, key=key))
    found["heldout_gain_share_median"] = by_class(rows, lambda some: median(some, "gain_share"))
    found["interval90_coverage"] = by_class(rows, coverage)
    found["calibration_error"] = calibration(rows)
    found["reliability"] = reliability(rows)
    found["right_above_09_rate"] = rate([one for one in claims(rows) if one["probability"] > SURE], "right")
    found["by_level"] = {level: one_level([row for row in rows if row["level"] == level]) for level in levels(rows)}
    met = [row for row in rows if row.get("peer_named_first") is not None]
    found["named_first_rate_where_peer"] = by_class(met, lambda some: rate(some, "named_first")) if met else None
    found["peer_named_first_rate"] = found["peer_named_first_rate"] if met else None
    return found


def by_class(rows: list[Row], score: Callable[[list[Row]], Row]) -> Row:
    concealed = [row for row in rows if row["lambda"] is not None]
    parts = {name: [row for row in concealed if low <= row["lambda"] < high] for name, (low, high) in CLASSES.items()}
    return {"all": score(concealed), **{name: score(some) for name, some in parts.items()}}


def median(rows: Iterable[Row], key: str) -> Row:
    values = [row[key] for row in rows if row.get(key) is not None]
    return {"value": float(np.median(values)) if values else None, "count": len(values), "wilson95": None}


def coverage(rows: Iterable[Row]) -> Row:
    return rate([number for row in rows for number in row["parameters"]], "covered")


def calibration(rows: Iterable[Row]) -> Row:
    """Expected calibration error: mean of |mean probability - right share| over tenths of the probability, by count."""
    tenths = [one for one in reliability(rows) if one["count"]]
    count = sum(one["count"] for one in tenths)
    total = sum(abs(one["probability"] - one["value"]) * one["count"] for one in tenths)
    return {"value": total / count if count else None, "count": count, "wilson95": None}


def reliability(rows: Iterable[Row]) -> list[Row]:
    """For each tenth of the probability of claims: their mean probability, and the share that is right."""
    said = claims(rows)
    found = []
    for tenth in range(10):
        some = [one for one in said if min(int(10 * one["probability"]), 9) == tenth]
        mean = float(np.mean([one["probability"] for one in some])) if some else None
        found.append({"from": tenth / 10, "to": (tenth + 1) / 10, "probability": mean, **rate(some, "right")})
    return found


def claims(rows: Iterable[Row]) -> list[Row]:
    """All named effects, each with its probability and whether it is part of the truth."""
    return [one for row in rows for one in row["claims"]]


def levels(rows: Iterable[Row]) -> list[str]:
    return sorted({row["level"] for row in rows})


def one_level(rows: list[Row]) -> Row:
    keys = ("false_alarm", "located", "named_first", "named_top3", "two_both", "two_one", "unknown", "misnamed")
    return {key: rate(rows, key) for key in keys if any(row.get(key) is not None for row in rows)}
