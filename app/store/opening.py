"""The store of an installation."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

from app.config import Settings
from app.store.base import Store
from app.store.in_folder import FolderStore
from rths_engine.foundation.errors import Issue, RthsError

FILE = "file"
SECRETS = "give credentials as AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or by AWS_SHARED_CREDENTIALS_FILE"


def store_of(settings: Settings) -> Store:
    """The store that the settings name; without one, the data folder."""
    return opened(settings.store, settings.data.resolve(), settings.store_endpoint, settings.store_cache)


@lru_cache(maxsize=16)
def opened(address: str, data: Path, endpoint: str = "", cache_limit: int = 0) -> Store:
    """The store at an address; `data` holds local copies of files from a network, `cache_limit` bytes at most.

    Raises RthsError for an address that cannot be used.
    """
    if not address:
        return FolderStore(data)
    parts = urlsplit(address)
    if parts.scheme == FILE:
        path = Path(unquote(parts.path))
        if parts.netloc or not path.is_absolute():
            raise RthsError(Issue("store", "needs an absolute path", address, "write file:///shared/rths"))
        return FolderStore(path)
    if not parts.scheme or not parts.netloc:
        raise RthsError(Issue("store", "is not an address", address, "write file:///shared/rths or s3://bucket/prefix"))
    if parts.username or parts.password:
        raise RthsError(Issue("store", "holds a user or a password", parts.hostname, SECRETS))
    from app.store.remote import RemoteStore

    return RemoteStore(address, data / "cache", endpoint, cache_limit)
