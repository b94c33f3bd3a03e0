"""The disk guard: below a reserve of free space nothing new is accepted, so that the tests that run can still be stored."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from app.config import MEGABYTE, Settings
from app.full import FIX, DiskFull, is_full

LEAST, SHARE, MOST = 2000 * MEGABYTE, 0.05, 20_000 * MEGABYTE
SMALL = 0.25  # of a small disk, such as that of a test, at most this share is kept free


@dataclass(frozen=True, slots=True)
class Space:
    """Free space (bytes) of the disk that holds the data folder, and the part that the guard keeps free."""

    free: int
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
    return Space(usage.free, reserve(settings, usage.total))


def reserve(settings: Settings, total: int) -> int:
    """The space (bytes) that is kept free on a disk of `total` bytes: as configured, or 5 % of the disk, within bounds."""
    if settings.disk_reserve is not None:
        return settings.disk_reserve
    return int(min(max(LEAST, min(SHARE * total, MOST)), SMALL * total))


def require(settings: Settings, size: int = 0) -> None:
    """Raise DiskFull where less than the reserve would be free after `size` bytes more."""
    found = space(settings)
    if found.free - size < found.reserve:
        asked = f", and this request has {shown(size)}" if size > MEGABYTE else ""
        raise DiskFull(f"{found.sentence}{asked}. Nothing was stored; what is stored stays readable. {FIX}.")


@contextmanager
def held(path: Path, size: int) -> Iterator[Callable[[], None]]:
    """Hold `size` bytes of the disk for the file `path`, in a file beside it, until the function that it gives is called.

    Raises DiskFull where they are not free, and where the disk is full in spite of it.
    """
    room = path.with_name(f"{path.name}.room")

    def release() -> None:
        room.unlink(missing_ok=True)

    try:
        room.parent.mkdir(parents=True, exist_ok=True)
        with room.open("wb") as file:
            os.posix_fallocate(file.fileno(), 0, max(size, 1))
        yield release
    except OSError as error:
        if not is_full(error):
            raise
        raise DiskFull(f"The disk has no room for the recording, {shown(size)} at most. {FIX}, then retry the test.") from None
    finally:
        release()


def shown(size: int) -> str:
    """A size in the unit that fits it."""
    return f"{size / 1e9:.1f} GB" if size >= 1e9 else f"{size / 1e6:.1f} MB"
