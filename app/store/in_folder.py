"""A store in a folder of this machine, or in one that several machines share."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path

from app import private
from app.store.base import Store
from app.store.checks import check
from app.store.filed import Filed
from rths_engine.foundation import files


class FolderStore(Store):
    """Files below a folder, each under its key and with the rights of the folder: private, or shared with a group."""

    def __init__(self, root: Path):
        self.root, self.where = root, str(root)

    def verified(self, filed: Filed) -> Path:
        return check(self.root / filed.key, filed)

    def scratch(self, prefix: str) -> Path:
        return self._folder(self.root / prefix)

    def put(self, path: Path, key: str, sha256: str | None = None) -> None:
        target = self.root / key
        self._folder(target.parent)
        if path != target:
            _move(path, target)
        private.like(target, self.root)
        files.sync(target.parent)

    def has(self, key: str) -> bool:
        return (self.root / key).is_file()

    def delete(self, key: str) -> None:
        (self.root / key).unlink(missing_ok=True)

    def listed(self, prefix: str) -> dict[str, int]:
        try:
            found = list(os.scandir(self.root / prefix))
        except FileNotFoundError:
            return {}
        kept = (one for one in found if one.is_file() and not one.name.startswith("."))
        return {f"{prefix}/{one.name}": one.stat().st_size for one in kept}

    def fetch(self, key: str, target: Path) -> None:
        shutil.copyfile(self.root / key, target)

    def folder(self, prefix: str, within_s: float = 0.0) -> Path:
        return self.root / prefix

    def keep(self, prefix: str, name: str) -> None:
        private.like(self.root / prefix / name, self.root)
        files.sync(self.root / prefix)

    def _folder(self, folder: Path) -> Path:
        """Make a folder with the rights of the store's own folder."""
        if not folder.is_dir():
            folder.mkdir(parents=True, exist_ok=True)
            for one in (folder, *folder.parents):
                if one == self.root or self.root not in one.parents:
                    break
                private.like(one, self.root)
        return folder


def _move(path: Path, target: Path) -> None:
    """Rename a file; where it lies on another disk, copy it beside the target, force it to the disk, and rename the copy."""
    try:
        os.replace(path, target)
        return
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
    with files.temporary(target) as copied:
        shutil.copyfile(path, copied)
        files.sync(copied)
        copied.replace(target)
    path.unlink()
