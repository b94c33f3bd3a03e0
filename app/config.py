"""Settings of the service, from arguments and RTHS_* environment variables."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from app import logs, private
from app.own_names import own_names
from rths_engine.foundation.errors import Issue, RthsError

MEGABYTE = 1_000_000
PROBES = frozenset({"/livez", "/healthz", "/readyz"})  # answered under any host name: monitors use the machine's address
FORMS = frozenset({"multipart/form-data", "application/x-www-form-urlencoded"})
LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})
ANY = frozenset({"0.0.0.0", "::", ""})  # listens on every address of this computer


@dataclass(frozen=True, slots=True)
class Variable:
    """An environment variable that sets a field of Settings: `read` makes the value of its text, `written` the text of a value.

    `default` words a default that is no single value.
    """

    key: str
    read: Callable[[str], Any]
    meaning: str
    written: Callable[[Any], str] = str
    default: str = ""


@dataclass(frozen=True, slots=True)
class Settings:
    """Everything that differs between installations. All data is in the folder `data`; limits are in bytes.

    `hosts` are the host names that browsers use when they differ from those of this computer, for example behind a proxy.
    With `local_sign_in` a request from this computer without credentials acts as an administrator.
    With `store`, recordings, measured files and ground motions lie there instead: app/store.
    """

    data: Path = Path("rths-data")
    database_url: str = ""
    host: str = "127.0.0.1"
    port: int = 8000
    hosts: tuple[str, ...] = ()
    embedded_worker: bool = True
    worker_concurrency: int = 2
    sweep_processes: int = field(default_factory=lambda: os.cpu_count() or 1)
    worker_token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    upload_limit: int = 20 * MEGABYTE
    measurements_limit: int = 1100 * MEGABYTE
    json_limit: int = 8 * MEGABYTE
    rig_host: str = "127.0.0.1"
    local_sign_in: bool = False
    laboratory: str = ""
    laboratory_address: str = ""
    laboratory_logo: Path | None = None
    store: str = ""
    store_endpoint: str = ""
    store_cache: int = 10_000 * MEGABYTE
    disk_reserve: int | None = None
    log_format: str = logs.TEXT
    log_level: str = "warning"
    tls_certificate: Path | None = None
    tls_key: Path | None = None
    ca: Path | None = None

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

    @property
    def measured(self) -> Path:
        return self.data / "measured"

    @property
    def fmus(self) -> Path:
        """FMUs that plans may name: machine code, put here by whoever operates the service, never uploaded."""
        return self.data / "fmus"

    def body_limit(self, path: str, content_type: str) -> int:
        """Largest body (bytes) of a request: forms hold files, and files of measurements have a limit of their own."""
        if not is_form(content_type):
            return min(self.json_limit, self.upload_limit)
        return self.measurements_limit if path.startswith("/api/v1/recordings") else self.upload_limit

    @property
    def on_network(self) -> bool:
        """Whether other computers can reach the service."""
        return self.host not in LOOPBACK

    @property
    def known_hosts(self) -> frozenset[str]:
        """Host names that a request may use, in lower case; on a network without `hosts` those of this computer too."""
        own = own_names() if self.on_network and not self.hosts else frozenset()
        return frozenset(name.lower() for name in (*LOOPBACK, *self.hosts, *own, *([] if self.host in ANY else [self.host])))

    @property
    def by_any_address(self) -> bool:
        """Whether a request may use any IP address as host: on a network without `hosts`. See docs/decisions/0078."""
        return self.on_network and not self.hosts

    def prepared(self) -> Settings:
        """Create the folders, private to the user of this process; returns the same settings."""
        private.made(self.data)
        with private.writing():
            for folder in (self.recordings, self.motions, self.measured, self.fmus):
                folder.mkdir(exist_ok=True)
        return self


def is_form(content_type: str) -> bool:
    """Whether a body is a form, which can hold files."""
    return content_type.partition(";")[0].strip().lower() in FORMS


def from_environment(**given: Any) -> Settings:
    """Settings from the variables in VARIABLES; a value in `given` that is not None takes precedence. Raises RthsError."""
    texts = {name: variable(one.key) for name, one in VARIABLES.items()}
    found = {name: _read(VARIABLES[name], text) for name, text in texts.items() if text}
    return replace(Settings(), **{**found, **{name: value for name, value in given.items() if value is not None}})


def variable(key: str) -> str:
    """The text of a variable, or what the file holds that KEY_FILE names: secrets stay out of the environment.

    Raises RthsError for a file that cannot be read.
    """
    text, named = os.environ.get(key, ""), os.environ.get(f"{key}_FILE")
    if text or not named:
        return text
    try:
        return Path(named).read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "is not text"
        raise RthsError(Issue(f"{key}_FILE", f"can't be read: {why}", named, "correct or unset the variable")) from None


def _read(one: Variable, text: str) -> Any:
    try:
        return one.read(text)
    except ValueError as error:
        needs = str(error) if str(error).startswith("needs ") else "needs a whole number"
        raise RthsError(Issue(one.key, needs, text, "correct or unset the variable")) from None


def _one_of(known: tuple[str, ...]) -> Callable[[str], str]:
    def read(text: str) -> str:
        if text not in known:
            raise ValueError(f"needs one of {', '.join(known)}")
        return text

    return read


def _megabytes(text: str) -> int:
    return int(text) * MEGABYTE


def _in_megabytes(size: int) -> str:
    return str(size // MEGABYTE)


VARIABLES: dict[str, Variable] = {
    "data": Variable("RTHS_DATA", Path, "data folder"),
    "host": Variable("RTHS_HOST", str, "address to listen on; 127.0.0.1 is this machine only"),
    "port": Variable("RTHS_PORT", int, "port to listen on"),
    "hosts": Variable(
        "RTHS_HOSTS",
        lambda text: tuple(text.split(",")),
        "host names that browsers use, separated by commas: behind a proxy, or where they are not those of this computer",
        default="the names and addresses of this computer",
    ),
    "worker_concurrency": Variable("RTHS_WORKERS", int, "tests that run at the same time"),
    "sweep_processes": Variable(
        "RTHS_SWEEP_PROCESSES", int, "processes of a worker that execute sweeps", default="one for each processor core"
    ),
    "database_url": Variable("RTHS_DATABASE_URL", str, "URL of a PostgreSQL database", default="SQLite in the data folder"),
    "worker_token": Variable(
        "RTHS_WORKER_TOKEN", str, "token of workers that cannot read the data folder", default="the file `worker-token` there"
    ),
    "upload_limit": Variable("RTHS_UPLOAD_LIMIT_MB", _megabytes, "largest request accepted, MB", _in_megabytes),
    "measurements_limit": Variable(
        "RTHS_MEASUREMENTS_LIMIT_MB", _megabytes, "largest file of measurements accepted, MB", _in_megabytes
    ),
    "json_limit": Variable("RTHS_JSON_LIMIT_MB", _megabytes, "largest request without a file accepted, MB", _in_megabytes),
    "rig_host": Variable(
        "RTHS_RIG_HOST", str, "address at which the rig of a test with a client listens; whoever reaches it moves the rig"
    ),
    "laboratory": Variable("RTHS_LABORATORY", str, "name of the laboratory in reports, until the settings page sets one"),
    "laboratory_address": Variable("RTHS_LABORATORY_ADDRESS", str, "address line of the laboratory in reports, likewise"),
    "laboratory_logo": Variable(
        "RTHS_LABORATORY_LOGO", Path, "PNG or SVG file with the laboratory's logo, likewise", default="none"
    ),
    "store": Variable(
        "RTHS_STORE",
        str,
        "address of recordings, measured files and ground motions: file:///shared/rths or s3://bucket/prefix",
        default="the data folder",
    ),
    "store_endpoint": Variable("RTHS_STORE_ENDPOINT", str, "URL of an S3-compatible server", default="that of AWS"),
    "tls_certificate": Variable(
        "RTHS_TLS_CERTIFICATE", Path, "PEM file with the certificate of the service: it answers https", default="none"
    ),
    "tls_key": Variable("RTHS_TLS_KEY", Path, "PEM file with the key of the certificate", default="in the certificate's file"),
    "ca": Variable(
        "RTHS_CA",
        Path,
        "PEM file with the certificates that a worker trusts at wss:// addresses",
        default="those of the system",
    ),
    "store_cache": Variable(
        "RTHS_STORE_CACHE_MB", _megabytes, "local copies of files of an S3 store, in the data folder, MB", _in_megabytes
    ),
    "disk_reserve": Variable(
        "RTHS_DISK_RESERVE_MB",
        _megabytes,
        "free disk space below which new tests and uploads are refused, MB",
        default="5 % of the disk, 2 GB at least and 20 GB at most, or a quarter of a small disk",
    ),
    "log_format": Variable(
        logs.FORMAT_KEY, _one_of(logs.FORMATS), "form of the log: text, or json with one object on each line"
    ),
    "log_level": Variable(logs.LEVEL_KEY, _one_of(logs.LEVELS), "least level that is logged: debug, info, warning or error"),
}
