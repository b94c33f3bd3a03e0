"""`rths league`: run the league of compensators on the virtual RTHS benchmark and print its table."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from pathlib import Path

from tqdm import tqdm

from app.cli.league_place import check
from app.cli.league_text import text
from app.cli.run_input import check_folder
from app.cli.settings import settings
from app.league.service import LeagueService, shipped
from app.store.filed import LEAGUE, MOTIONS
from app.store.motions import motions_of
from app.store.opening import store_of
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.league.running import Wanted
from rths_engine.league.running import league as run_league
from rths_engine.league.table import merged, write


def league(given: Namespace) -> None:
    """`rths league`: run it and store the results where the page looks for them. Raises RthsError for invalid input."""
    found = settings(given)
    store = store_of(found)
    out: Path = given.out or store.folder(LEAGUE) / f"case-{given.case}.json"
    if given.out:
        check_folder(out, "--out", "league.json")
    wanted = Wanted(given.case, given.record, given.plants, tuple(given.only))
    service = LeagueService(store)
    if not given.out:
        wanted.check(motions_of(found))
        check(wanted, service.shown(given.case), shipped(given.case))
    with tqdm(total=0, unit="test", disable=None, file=sys.stderr) as bar:

        def progress(done: int, total: int) -> None:
            bar.total, bar.n = total, done
            bar.refresh()

        result = run_league(wanted, store.folder(MOTIONS), given.processes or os.cpu_count() or 1, _command(given), progress)
    earlier = service.shown(given.case) if wanted.only and not given.out else None
    stored = merged(earlier, result) if earlier else result
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with files.temporary(out) as written:
            written.write_text(write(stored), encoding="utf-8")
            os.replace(written, out)
        if not given.out:
            store.keep(LEAGUE, out.name)
    except OSError as error:
        raise RthsError(Issue("--out", f"was not written: {error.strerror}", str(out), "choose another file")) from None
    print(text(result))
    kept = " beside the rows measured earlier" if earlier else ""
    print(f"Stored in {out}{kept}.")


def _command(given: Namespace) -> str:
    """The command that gives these results again."""
    only = f" --only {' '.join(given.only)}" if given.only else ""
    return f"rths league --case {given.case} --record {given.record} --plants {given.plants}{only}"
