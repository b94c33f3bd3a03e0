"""Where `rths league` may put its results: a partial or differently measured league never hides a whole one."""

from __future__ import annotations

from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.league.running import Wanted
from rths_engine.league.table import League


def check(wanted: Wanted, shown: League | None, shipped: League | None) -> None:
    """Raise RthsError, before a test runs, where the results of `wanted` would hide the league that the page shows."""
    out = "write it to a file of its own with --out"
    if wanted.only and shown is None:
        fix = f"run `rths league --case {wanted.case}` without --only first, or {out}"
        raise RthsError(Issue("--only", "is a part of a league of which no whole was measured", " ".join(wanted.only), fix))
    kept = shown if wanted.only else shipped
    if kept is None:
        return
    for option, given, there in (("--record", wanted.record, kept.record), ("--plants", wanted.plants, kept.plants)):
        if given != there:
            fix = f"use {option} {there}, or {out}"
            raise RthsError(Issue(option, "differs from that of the league on the page, which it would hide", given, fix))
