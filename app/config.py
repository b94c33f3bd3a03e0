"""Settings of the service, from arguments and RTHS_* environment variables."""

from __future__ import annotations

import os
import secrets
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

MEGABYTE = 1_000_000


@dataclass(frozen=True, slots=True)
class Settings:
    """Everything that differs between installations. All data lives in the folder `data`."""

    data: Path = Path("rths-data")
    database_url: str = ""
    host: str = "127.0.0.1"
    port: int = 8000
    embedded_worker: bool = True
    worker_concurrency: int = 2
    worker_token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    upload_limit: int = 20 * MEGABYTE

    @property
    def url(self) -> str:
        """The database: the given URL, or a SQLite file in the data folder."""
        return self.database_url or f"sqlite:///{self.data.resolve() / 'rths.sqlite'}"

    @property
    def recordings(self) -> Path:
        return self.data / "recordings"

    @property
    def motions(self) -> Path:
        return self.data / "motions"

    def prepared(self) -> Settings:
        """The same settings with their folders made."""
        for folder in (self.data, self.recordings, self.motions):
            folder.mkdir(parents=True, exist_ok=True)
        return self


def from_environment(**given: Any) -> Settings:
    """Settings from RTHS_DATA, RTHS_DATABASE_URL, RTHS_HOST, RTHS_PORT, RTHS_WORKERS, RTHS_WORKER_TOKEN; `given` wins."""
    read = {
        "data": ("RTHS_DATA", Path),
        "database_url": ("RTHS_DATABASE_URL", str),
        "host": ("RTHS_HOST", str),
        "port": ("RTHS_PORT", int),
        "worker_concurrency": ("RTHS_WORKERS", int),
        "worker_token": ("RTHS_WORKER_TOKEN", str),
    }
    found = {name: convert(os.environ[key]) for name, (key, convert) in read.items() if os.environ.get(key)}
    return replace(Settings(), **{**found, **{name: value for name, value in given.items() if value is not None}})
