"""`rths backup`, `rths restore`, `rths verify`."""

from __future__ import annotations

import sys
from argparse import Namespace

from app.backup.making import make
from app.backup.restoring import restore as restored
from app.backup.verifying import verify as verified
from app.cli.main import DONE, FAILED
from app.cli.settings import settings
from app.disk import shown


def backup(given: Namespace) -> int:
    """`rths backup`: make a backup; returns 1 where files of rows were missing or damaged."""
    made = make(settings(given), given.to, _told)
    kept = made.manifest.files
    size = shown(sum(one.size for one in kept.values()))
    rows = sum(made.manifest.rows.values())
    files = len(kept) - 1  # beside the database, as `rths restore` counts them
    print(f"{made.folder}\n{rows} rows and {files} files ({size}), of which {made.linked} are links to the backup before.")
    for problem in made.manifest.damaged.values():
        print(f"not in the backup: {problem}", file=sys.stderr)
    return FAILED if made.manifest.damaged else DONE


def restore(given: Namespace) -> int:
    """`rths restore`: restore a backup into an empty data folder, or into an empty database."""
    found = restored(settings(given), given.backup, _told)
    audit = f" The audit log ends with entry {found.audit['number']}, {found.audit['hash']}." if found.audit else ""
    print(f"Restored {sum(found.rows.values())} rows and {len(found.files) - 1} files, as of {found.made_at}.{audit}")
    print("Check them with `rths verify`, then start the control room.")
    return DONE


def verify(given: Namespace) -> int:
    """`rths verify`: check every stored file; returns 1 where a file is missing or damaged."""
    found = verified(settings(given))
    print(f"{found.good} files are as their rows state; {len(found.damaged)} are not.")
    for problem in found.damaged.values():
        print(problem)
    if found.without_row:
        print(f"{len(found.without_row)} files have no row:")
        for key in found.without_row:
            print(f"  {key}")
    return FAILED if found.damaged else DONE


def _told(doing: str) -> None:
    print(f"{doing} ...", file=sys.stderr, flush=True)
