"""JSON forms of the league."""

from __future__ import annotations

from pydantic import BaseModel, Field

from app.league.trial import Trial
from rths_engine.league.criteria import CRITERIA, Criterion
from rths_engine.league.table import League


class CriterionOut(BaseModel):
    """A criterion J1 to J9: the measure that it is, with label, unit, formula and meaning."""

    symbol: str
    words: str
    measure: str
    label: str
    unit: str
    formula: str
    meaning: str

    @classmethod
    def of(cls, criterion: Criterion) -> CriterionOut:
        one = criterion.measure
        return cls(
            symbol=criterion.symbol,
            words=criterion.words,
            measure=one.key,
            label=one.label,
            unit=one.shown_label,
            formula=one.formula,
            meaning=criterion.meaning,
        )


class LeagueOut(BaseModel):
    """The league of a partitioning case. `cases` are those with results; `shipped`: measured before this installation."""

    cases: list[int]
    shipped: bool
    criteria: list[CriterionOut] = Field(default_factory=lambda: [CriterionOut.of(one) for one in CRITERIA])
    league: League
    other_program: Trial | None = Field(description="Figures of another program for the same test, beside `quiet` of the rows.")
