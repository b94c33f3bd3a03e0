"""Tables of docs/league.md: the criteria, and the shipped league."""

from __future__ import annotations

from app.documents.markdown import table
from app.league.service import SHIPPED
from app.league.trial import TRIAL
from rths_engine.league.criteria import CRITERIA
from rths_engine.league.table import Row, read


def criteria() -> str:
    """The criteria J1 to J9 and the measures that they are."""
    rows = [(one.symbol, f"`{one.key}`", one.measure.shown_label, f"`{one.measure.formula}`", one.meaning) for one in CRITERIA]
    return table(("criterion", "measure", "unit", "formula", "meaning"), rows)


def league() -> str:
    """The shipped league of case 1: nominal values, and J2 over the perturbed plants."""
    found = read((SHIPPED / "case-1.json").read_text(encoding="utf-8"), "case-1.json")
    units = [f"{one.symbol}, {one.measure.shown_label}" for one in CRITERIA]
    heads = ("compensator", *units, "J2 without noise", f"J2, {found.plants} plants", "completed")
    return table(heads, [_row(row) for row in found.rows])


def other_program() -> str:
    """The figures of another program beside ours without sensor noise, and why they differ."""
    heads = ("compensator", "our J1, ms", "our J2, %", "J1 of another program, ms", "J2 of another program, %", "why")
    found = read((SHIPPED / "case-1.json").read_text(encoding="utf-8"), "case-1.json")
    rows = []
    for row in found.rows:
        if theirs := TRIAL.beside(row):
            ours = [_text(row.quiet.criteria[one] if row.quiet.status == "completed" else None) for one in ("J1", "J2")]
            rows.append((row.title, *ours, f"{theirs.j1_ms:g}", f"{theirs.j2_percent:g}", theirs.why))
    return f"Source: {TRIAL.source}. Compare them with our figures without noise.\n\n{table(heads, rows)}"


def _row(row: Row) -> tuple[str, ...]:
    ended = row.nominal.status == "completed"
    nominal = [_text(row.nominal.criteria[one.symbol] if ended else None) for one in CRITERIA]
    quiet = _text(row.quiet.criteria["J2"] if row.quiet.status == "completed" else None)
    mean, deviation = row.spread.mean["J2"], row.spread.deviation["J2"]
    over = "–" if mean is None else _text(mean) + ("" if deviation is None else f" ± {_text(deviation)}")
    return row.title, *nominal, quiet, over, f"{row.spread.completed} of {len(row.plants)}"


def _text(value: float | None) -> str:
    """Three significant digits, at most three decimals; a dash where there is no value."""
    if value is None:
        return "–"
    return f"{value:.3f}".rstrip("0").rstrip(".") if abs(value) < 0.1 else f"{value:#.3g}".rstrip(".")
