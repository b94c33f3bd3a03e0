"""A stored file as its row describes it, and the keys of files in the store."""

from __future__ import annotations

from dataclasses import dataclass

RECORDINGS, MEASURED, RAW = "recordings", "measured", "measured/raw"
MOTIONS, FMUS, LABORATORY, LEAGUE = "motions", "fmus", "laboratory", "league"

RESTORE = "restore the file from a backup"


@dataclass(frozen=True, slots=True)
class Filed:
    """A stored file: its key, its name for people, and the checksum (hex SHA-256) and size (bytes) that its row states.

    `fix` says what to do where the file is not as its row states.
    """

    key: str
    what: str
    sha256: str
    size: int | None
    fix: str = RESTORE


def of_run(run_id: str) -> str:
    """Key of the recording of a run."""
    return f"{RECORDINGS}/{run_id}.h5"


def of_measured(recording_id: str) -> str:
    """Key of an imported recording."""
    return f"{MEASURED}/{recording_id}.h5"


def of_raw(sha256: str) -> str:
    """Key of an uploaded file of measurements."""
    return f"{RAW}/{sha256}"
