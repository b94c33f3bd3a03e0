"""The disk guard: below a reserve of free space nothing large is accepted, so that the tests that run can still be stored."""

from __future__ import annotations

import errno
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from app.config import MEGABYTE, Settings

LEAST, SHARE, MOST = 2000 * MEGABYTE, 0.05, 20_000 * MEGABYTE
SMALL = 0.25  # of a small disk, such as that of a test, at most this share is kept free
NO_SPACE = {errno.ENOSPC, errno.EDQUOT}
FIX = "Delete recordings, set a retention, or enlarge the disk"


class DiskFull(Exception):
    """Something is not stored, because the disk has too little space."""


@dataclass(frozen=True, slots=True)
class Space:
    """Free and total space (bytes) of the disk that holds `folder`, and the part that the guard keeps free."""

    folder: Path
    free: int
    total: int
    reserve: int

    @property
    def low(self) -> bool:
        return self.free < self.reserve

    @property
    def sentence(self) -> str:
        return f"The disk of the data folder has {shown(self.free)} free; the service keeps {shown(self.reserve)} free"


def space(settings: Settings) -> Space:
    """The space of the disk that holds the data folder."""
    usage = shutil.disk_usage(settings.data)
    return Space(settings.data, usage.free, usage.total, reserve(settings, usage.total))


def reserve(settings: Settings, total: int) -> int:
    """The space (bytes) that is kept free: as configured, or 5 % of the disk, within bounds."""
    if settings.disk_reserve is not None:
        return settings.disk_reserve
    return int(min(max(LEAST, min(SHARE * total, MOST)), SMALL * total))


def require(settings: Settings, size: int = 0) -> None:
    """Raise DiskFull where less than the reserve would be free after `size` bytes more."""
    found = space(settings)
    if found.free - size < found.reserve:
        asked = f" and this needs {shown(size)}" if size else ""
        raise DiskFull(f"{found.sentence}{asked}. Nothing was stored, and what is stored stays readable. {FIX}.")


@contextmanager
def held(path: Path, size: int) -> Iterator[None]:
    """Hold `size` bytes of the disk in a file beside `path` meanwhile. Raises DiskFull where they are not free."""
    import os

    room = path.with_name(f"{path.name}.room")
    try:
        with room.open("wb") as file:
            if size:
                os.posix_fallocate(file.fileno(), 0, size)
        yield
    except OSError as error:
        if not is_full(error):
            raise
        fix = f"{FIX}, then retry the test"
        raise DiskFull(f"The disk has no room for the recording, {shown(size)} at most. {fix}.") from None
    finally:
        room.unlink(missing_ok=True)


def is_full(error: BaseException | None) -> bool:
    """Whether an error, or the error that caused it, says that the disk or the user's share of it is full."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in NO_SPACE:
            return True
        if any(said in str(error) for said in ("No space left on device", "database or disk is full")):
            return True  # h5py gives no number, and SQLite words
        if getattr(getattr(error, "orig", error), "sqlstate", None) == "53100":
            return True  # PostgreSQL
        error = error.__cause__
    return False


def shown(size: int) -> str:
    """A size in the unit that fits it."""
    return f"{size / 1e9:.1f} GB" if size >= 1e9 else f"{size / 1e6:.1f} MB"
