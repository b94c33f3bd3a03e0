"""Errors of a disk that is full, however a library words them."""

from __future__ import annotations

import errno

NO_SPACE = {errno.ENOSPC, errno.EDQUOT}
WORDS = ("No space left on device", "database or disk is full")  # h5py gives no number; SQLite words
POSTGRES = "53100"  # disk_full
FIX = "Delete what is no longer needed, or enlarge the disk"


class DiskFull(Exception):
    """Something is not stored, because the disk has too little space."""


def is_full(error: BaseException | None) -> bool:
    """Whether an error, or the error that caused it, says that the disk or the user's share of it is full."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in NO_SPACE:
            return True
        if any(said in str(error) for said in WORDS):
            return True
        if getattr(getattr(error, "orig", None), "sqlstate", None) == POSTGRES:
            return True
        error = error.__cause__
    return False
