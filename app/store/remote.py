"""A store behind a network, such as S3, through fsspec. Files are read from verified local copies."""

from __future__ import annotations

import itertools
import logging
import os
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import fsspec

from app.store.base import Store, StoreSilent
from app.store.checks import KNOWN, check, missing
from app.store.copies import Copies
from app.store.filed import Filed
from app.store.mirror import Mirror
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

log = logging.getLogger("rths.store")
EXTRA = {"s3": "s3", "s3a": "s3"}
Result = TypeVar("Result")


class RemoteStore(Store):
    """Files below a URL. Local copies of them are in `cache`, `limit` bytes at most.

    An object appears when its upload is complete, so a cut upload leaves nothing that can be read.
    """

    def __init__(self, address: str, cache: Path, endpoint: str = "", limit: int = 0):
        self.where = address.rstrip("/")
        self.endpoint = endpoint
        self.copies = Copies(cache / "files", limit)
        self._cache, self._numbers = cache, itertools.count()
        self._mirrors: dict[str, Mirror] = {}

    def __reduce__(self) -> tuple[type[RemoteStore], tuple[str, Path, str, int]]:
        """A store of its own for the process of a calculation, with the same local copies."""
        return RemoteStore, (self.where, self._cache, self.endpoint, self.copies.limit)

    @cached_property
    def files(self) -> Any:
        """The file system of fsspec, opened when it is first needed, and root, the path within it."""
        scheme = self.where.partition(":")[0]
        options: dict[str, Any] = {"use_listings_cache": False} if scheme in EXTRA else {}
        if self.endpoint:
            options["endpoint_url"] = self.endpoint
        try:
            return fsspec.filesystem(scheme, **options)
        except (ImportError, ValueError) as error:
            extra = EXTRA.get(scheme)
            fix = f"install it: pip install 'rths-control-room[{extra}]'" if extra else "use file:// or s3://"
            raise RthsError(Issue("store", f"cannot be opened: {error}", self.where, fix)) from None

    def verified(self, filed: Filed) -> Path:
        copy = self.copies.of(filed.sha256)
        if not copy.exists() or KNOWN.of(copy)[0] != filed.sha256:
            copy.parent.mkdir(parents=True, exist_ok=True)
            with files.temporary(copy) as written:
                try:
                    self.fetch(filed.key, written)
                except FileNotFoundError:
                    raise missing(filed) from None
                check(written, filed)
                written.replace(copy)
            self.copies.trim()
        self.copies.used(copy)
        return copy

    def scratch(self, prefix: str) -> Path:
        folder = self._cache / "scratch"
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def put(self, path: Path, key: str, sha256: str | None = None) -> None:
        size = path.stat().st_size
        self._do(lambda: self.files.put_file(str(path), self._path(key)))
        stored = self._do(lambda: self.files.info(self._path(key))["size"])
        if stored != size:
            raise StoreSilent(f"the store {self.where} has {stored} of {size} bytes of {key}")
        if sha256:
            copy = self.copies.of(sha256)
            copy.parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, copy)
            self.copies.used(copy)
            self.copies.trim()
        else:
            path.unlink()

    def has(self, key: str) -> bool:
        return bool(self._do(lambda: self.files.exists(self._path(key))))

    def delete(self, key: str) -> None:
        def gone() -> None:
            try:
                self.files.rm_file(self._path(key))
            except FileNotFoundError:
                return

        self._do(gone)

    def listed(self, prefix: str) -> dict[str, int]:
        return {f"{prefix}/{name}": about["size"] for name, about in self.described(prefix).items()}

    def described(self, prefix: str) -> dict[str, Any]:
        """Name and description of each file directly below `prefix`."""

        def look() -> list[Any]:
            try:
                found: list[Any] = self.files.ls(self._path(prefix), detail=True)
                return found
            except FileNotFoundError:
                return []

        entries = ((one["name"].rpartition("/")[2], one) for one in self._do(look) if one["type"] == "file")
        return {name: one for name, one in entries if name and not name.startswith(".")}

    def fetch(self, key: str, target: Path) -> None:
        self._do(lambda: self.files.get_file(self._path(key), str(target)))

    def upload(self, path: Path, key: str) -> None:
        """Store a copy of a local file."""
        self._do(lambda: self.files.put_file(str(path), self._path(key)))

    def folder(self, prefix: str, within_s: float = 0.0) -> Path:
        return self._mirror(prefix).refreshed(within_s)

    def keep(self, prefix: str, name: str) -> None:
        self._mirror(prefix).keep(name)

    def drop(self, prefix: str, name: str) -> None:
        super().drop(prefix, name)
        self._mirror(prefix).forget(name)

    def _mirror(self, prefix: str) -> Mirror:
        return self._mirrors.setdefault(prefix, Mirror(self, prefix, self._cache / "mirrors" / prefix))

    def _path(self, key: str) -> str:
        return f"{self.where.partition('://')[2]}/{key}"

    def _do(self, act: Callable[[], Result]) -> Result:
        """Do one thing with the file system. Raises FileNotFoundError, and StoreSilent for every other failure."""
        try:
            return act()
        except (FileNotFoundError, RthsError):
            raise
        except Exception as error:
            log.warning("the store %s failed: %s: %s", self.where, type(error).__name__, error)
            raise StoreSilent(f"the store {self.where} did not answer: {error}") from error
