"""The scores of a proof as text."""

from __future__ import annotations

from typing import Any

from tests.proof.summary import CLASSES, rate

Row = dict[str, Any]


def scores(result: Row) -> str:
    """All scores with their counts, one score on each line."""
    lines = [f"{result['cases']} cases, {result['clean_cases']} of them clean; {result['broken']} without a diagnosis"]
    for name in ("false_alarm_rate", "falsely_named_rate", "calibration_error", "right_above_09_rate"):
        lines.append(f"{name:28} {_one(result[name])}")
    lines.append(f"{'by lambda':28} " + " ".join(f"{name:>15}" for name in ("all", *CLASSES)))
    for name, found in result.items():
        if isinstance(found, dict) and "all" in found:
            lines.append(f"{name:28} " + " ".join(f"{_one(found[part]):>15}" for part in ("all", *CLASSES)))
    return "\n".join(lines)


def effects(rows: list[Row]) -> str:
    """For each effect: number of cases, rates of located, named first and among the first three, and mean duration (s)."""
    lines = [f"{'effect':40} {'cases':>5} {'located':>8} {'first':>8} {'top 3':>8} {'s':>6}"]
    single = [row for row in rows if len(row["truth"]) == 1]
    kinds = {name: [row for row in single if row["truth"] == [name]] for name in sorted({row["truth"][0] for row in single})}
    kinds |= {
        name: [row for row in rows if row["outside"] == name] for name in sorted({row["outside"] or "" for row in rows} - {""})
    }
    kinds["none"] = [row for row in rows if row["false_alarm"] is not None]
    for name, some in kinds.items():
        if some:
            shares = " ".join(f"{_share(rate(some, key)):>8}" for key in ("located", "named_first", "named_top3"))
            lines.append(f"{name:40} {len(some):5} {shares} {sum(row['seconds'] for row in some) / len(some):6.1f}")
    return "\n".join(lines)


def _share(found: Row) -> str:
    return "-" if found["value"] is None else f"{100 * found['value']:.0f} %"


def _one(found: Row) -> str:
    return "-" if found["value"] is None else f"{100 * found['value']:.1f} % ({found['count']})"
