"""The data folder is private: other users of the computer read neither hashes of passwords nor tokens nor recordings."""

from __future__ import annotations

import logging
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

log = logging.getLogger("rths.private")
FOLDER, OTHERS = 0o700, 0o077
OURS = frozenset({"rths.sqlite", "worker-token", "recordings", "in-use.lock"})  # a folder with one of these is a data folder
_SAID: set[Path] = set()


@contextmanager
def writing() -> Iterator[None]:
    """Files and folders that are made meanwhile are for their owner only."""
    before = os.umask(OTHERS)
    try:
        yield
    finally:
        os.umask(before)


def made(folder: Path) -> None:
    """Make a data folder for its owner only. One that others may enter or read is closed to them where it is ours to close.

    It is where it belongs to this user and is empty or a data folder already; otherwise a warning says what to do.
    """
    if not folder.exists():
        with writing():
            folder.mkdir(parents=True)
        return
    found = folder.stat()
    if not found.st_mode & OTHERS:
        return
    problem = f"Other users of this computer could read the data folder {folder.resolve()}"
    if not _ours(folder, found):
        if folder not in _SAID:
            _SAID.add(folder)
            log.warning("%s. Close it, as its owner, with: chmod 700 %s", problem, folder.resolve())
        return
    folder.chmod(FOLDER)
    for one in os.scandir(folder):
        with suppress(OSError):  # gone meanwhile, or of another user, whom the folder keeps out now
            if not one.is_symlink():
                os.chmod(one.path, stat.S_IMODE(one.stat().st_mode) & ~OTHERS)
    log.warning("%s. It is closed to them now.", problem)


def like(path: Path, folder: Path) -> None:
    """Give a file or folder the rights of the folder that it lies in: private in a data folder, shared in a shared one.

    A file system without rights keeps its own.
    """
    rights = stat.S_IMODE(folder.stat().st_mode)
    with suppress(OSError):
        os.chmod(path, rights if path.is_dir() else rights & 0o666)


def _ours(folder: Path, found: os.stat_result) -> bool:
    if found.st_uid != os.geteuid() or found.st_mode & stat.S_ISVTX:
        return False
    names = {one.name for one in os.scandir(folder)}
    return not names or bool(names & OURS)
