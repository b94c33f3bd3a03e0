"""`rths scores`: published scores on the published split, beside the published figures."""

from __future__ import annotations

import json
from argparse import Namespace

from rths_engine.foundation import files
from rths_engine.foundation.errors import FileError, Issue, PlanError
from rths_engine.scores.score import Entry, Score
from rths_engine.scores.scored import BENCHMARKS


def scores(given: Namespace) -> None:
    """`rths scores`: fit models to the data sets of a folder, and print their errors beside the published errors."""
    if not given.folder.is_dir():
        raise FileError(Issue("FOLDER", "is not a folder", str(given.folder), "give the folder with the data sets"))
    if given.json and not given.json.parent.is_dir():
        raise PlanError(Issue("--json", f"there is no folder {given.json.parent}", str(given.json), "create it first"))
    found = []
    for benchmark in BENCHMARKS:
        found.append(benchmark(given.folder))
        print(_text(found[-1]), end="\n\n", flush=True)
    if given.json:
        files.write(given.json, json.dumps({"scores": [one.as_dict() for one in found]}, indent=1) + "\n")


def _text(one: Score) -> str:
    head = [f"{one.title}: {one.measure}{f', {one.unit}' if one.unit else ''}", f"  published split: {one.split}"]
    if one.lacks:
        head.append(f"  the folder lacks: {', '.join(one.lacks)}; published at {one.source}")
    if one.ranked:
        return "\n".join([*head, *(_row(entry) for entry in one.ranking())])
    rows = [*head, *(_row(Entry(f"{entry.model} (published)", entry.error)) for entry in one.published)]
    if not one.ours:
        return "\n".join([*rows, "  not scored"])
    ours = [_row(Entry(f"{entry.model} (this program)", entry.error)) for entry in one.ours]
    return "\n".join([*rows, f"  on another split, not ranked: {one.used}", *ours])


def _row(entry: Entry) -> str:
    return f"  {entry.error:>10.3g}  {entry.model}"
