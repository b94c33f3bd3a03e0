"""The data folder is closed to other users, and a store that people share keeps the rights of its folder."""

from __future__ import annotations

import logging
import os
from pathlib import Path

import pytest

from app import private
from app.config import Settings
from app.store.in_folder import FolderStore


def mode(path: Path) -> int:
    return path.stat().st_mode & 0o777


@pytest.fixture
def read_by_others(tmp_path: Path) -> Path:
    """A data folder as earlier versions made it."""
    folder = tmp_path / "rths"
    (folder / "recordings").mkdir(parents=True)
    (folder / "rths.sqlite").write_text("")
    for one in (folder, folder / "recordings"):
        one.chmod(0o755)
    (folder / "rths.sqlite").chmod(0o644)
    return folder


def test_a_new_data_folder_is_private(tmp_path: Path) -> None:
    folder = tmp_path / "one" / "rths"
    Settings(data=folder).prepared()
    assert {mode(one) for one in (folder, *folder.iterdir())} == {0o700}


def test_a_data_folder_that_others_can_read_is_closed_with_a_warning(
    read_by_others: Path, caplog: pytest.LogCaptureFixture
) -> None:
    Settings(data=read_by_others).prepared()
    assert [mode(read_by_others / name) for name in (".", "recordings", "rths.sqlite")] == [0o700, 0o700, 0o600]
    Settings(data=read_by_others).prepared()
    (said,) = [one.getMessage() for one in caplog.records]
    assert f"could read the data folder {read_by_others}. It is closed" in said


@pytest.mark.parametrize("why", ["of another user", "sticky, such as /tmp", "no data folder"])
def test_a_folder_that_is_not_ours_is_left_as_it_is_with_a_warning(
    read_by_others: Path, why: str, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = 0o755
    if why == "of another user":
        monkeypatch.setattr(os, "geteuid", lambda: 4711)
    elif why == "no data folder":
        (read_by_others / "rths.sqlite").rename(read_by_others / "thesis.tex")
        (read_by_others / "recordings").rmdir()
    else:
        read_by_others.chmod(0o1777)
        kept = 0o777
    for _ in range(2):
        private.made(read_by_others)
    assert mode(read_by_others) == kept
    (said,) = [one for one in caplog.records if one.levelno == logging.WARNING]
    assert f"chmod 700 {read_by_others}" in said.getMessage()


@pytest.mark.parametrize(("shared", "folder", "file"), [(0o700, 0o700, 0o600), (0o770, 0o770, 0o660), (0o755, 0o755, 0o644)])
def test_files_of_a_store_have_the_rights_of_its_folder(tmp_path: Path, shared: int, folder: int, file: int) -> None:
    root = tmp_path / "store"
    root.mkdir()
    root.chmod(shared)
    store = FolderStore(root)
    with private.writing():
        written = store.scratch("recordings") / ".one"
        written.write_bytes(b"recording")
        store.put(written, "measured/raw/one.h5")
    assert [mode(root / name) for name in ("recordings", "measured", "measured/raw")] == [folder] * 3
    assert mode(root / "measured/raw/one.h5") == file
