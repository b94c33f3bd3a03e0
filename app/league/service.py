"""The results of leagues: those of the data folder, and where it has none, those that came with the program."""

from __future__ import annotations

from pathlib import Path

from app.league.schemas import LeagueOut
from app.league.trial import trial
from app.problems import NotFound
from app.store.base import Store
from app.store.filed import LEAGUE
from rths_engine.league.table import League, read
from rths_engine.planning.vrths import CASES

FRESH_S = 2.0
SHIPPED = Path(__file__).parent / "measured"


def shipped(case: int) -> League | None:
    """The league of a case that came with the program."""
    path = SHIPPED / f"case-{case}.json"
    return read(path.read_text(encoding="utf-8"), path.name) if path.is_file() else None


class LeagueService:
    """Reads results of leagues; `rths league` writes them."""

    def __init__(self, store: Store):
        self.store = store

    def league(self, case: int) -> LeagueOut:
        """The league of a case. Raises NotFound where it was not measured, RthsError where its file is damaged."""
        path = self._path(case)
        if path is None:
            how = f"run `rths league --case {case}` on the server"
            raise NotFound(f"No league of case {case} was measured. To measure it, {how}.")
        league = read(path.read_text(encoding="utf-8"), f"league/{path.name}")
        return LeagueOut(cases=self.cases(), shipped=path.parent == SHIPPED, league=league, other_program=trial(league))

    def cases(self) -> list[int]:
        """The cases with results."""
        return [one for one in CASES if self._path(one)]

    def shown(self, case: int) -> League | None:
        """The league that the page shows; None where the case was not measured."""
        return self.league(case).league if self._path(case) else None

    def _path(self, case: int) -> Path | None:
        own = self.store.folder(LEAGUE, within_s=FRESH_S)
        found = (folder / f"case-{case}.json" for folder in (own, SHIPPED))
        return next((path for path in found if path.is_file()), None)
