"""The store: whole files or none, copies that are verified, folders that follow it; in a folder and behind a network."""

from __future__ import annotations

import errno
import hashlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fsspec
import numpy as np
import pytest

from app.config import Settings
from app.store import checks, copies
from app.store.base import Store, StoreSilent
from app.store.checks import Checksums, Damaged, check
from app.store.filed import Filed
from app.store.in_folder import FolderStore
from app.store.motions import StoredMotions
from app.store.opening import opened, store_of
from app.store.remote import RemoteStore
from rths_engine.foundation import files
from rths_engine.foundation.errors import RthsError
from rths_engine.parts.ground_motions import Motion

BYTES = b"a recording"
SHA256 = hashlib.sha256(BYTES).hexdigest()
FILED = Filed("recordings/run.h5", "The recording of run 1 (Test)", SHA256, len(BYTES))


@pytest.fixture
def remote(tmp_path: Path) -> Iterator[RemoteStore]:
    yield RemoteStore("memory://bucket/rths", tmp_path / "cache", limit=1_000_000)
    fsspec.filesystem("memory").store.clear()


@pytest.fixture(params=["folder", "remote"])
def store(request: pytest.FixtureRequest, tmp_path: Path) -> Store:
    found: Store = FolderStore(tmp_path / "store") if request.param == "folder" else request.getfixturevalue("remote")
    return found


def put(store: Store, key: str = FILED.key, content: bytes = BYTES, sha256: str | None = None) -> None:
    path = store.scratch("recordings") / "new"
    path.write_bytes(content)
    store.put(path, key, sha256)


def test_what_was_put_comes_back_is_listed_and_is_deleted(store: Store, tmp_path: Path) -> None:
    put(store)
    assert store.verified(FILED).read_bytes() == BYTES and list(store.scratch("recordings").glob("new")) == []
    assert store.listed("recordings") == {FILED.key: len(BYTES)} and store.listed("measured") == {}
    store.fetch(FILED.key, tmp_path / "copy")
    assert (tmp_path / "copy").read_bytes() == BYTES
    for _ in range(2):
        store.delete(FILED.key)
    assert store.listed("recordings") == {}
    with pytest.raises(FileNotFoundError):
        store.fetch(FILED.key, tmp_path / "none")


@pytest.mark.parametrize(
    ("content", "problem"),
    [(BYTES[:-1], f"has {len(BYTES) - 1} bytes"), (BYTES.upper(), f"its row states {SHA256}"), (None, "missing")],
)
def test_a_file_that_is_not_as_its_row_states_is_refused(store: Store, content: bytes | None, problem: str) -> None:
    if content is not None:
        put(store, content=content)
    with pytest.raises(Damaged, match=r"^The recording of run 1 \(Test\).*restore the file from a backup") as refused:
        store.verified(FILED)
    assert problem in str(refused.value) and FILED.key in str(refused.value)


def test_a_file_is_read_again_only_after_a_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    monkeypatch.setattr(checks, "KNOWN", Checksums())

    def checksum(path: Path, real: Any = files.checksum) -> str:
        read.append(path)
        found: str = real(path)
        return found

    monkeypatch.setattr(files, "checksum", checksum)
    path = tmp_path / "file"
    path.write_bytes(BYTES)
    for _ in range(3):
        check(path, FILED)
    assert len(read) == 1
    before = path.stat()
    path.write_bytes(BYTES.upper())
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))  # same size, same time of the last change
    with pytest.raises(Damaged):
        check(path, FILED)
    assert len(read) == 2


def test_a_file_moves_to_a_folder_on_another_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def renamed(source: Path, target: Path, real: Any = os.replace) -> None:
        if source == path:
            raise OSError(errno.EXDEV, "Invalid cross-device link")
        real(source, target)

    store = FolderStore(tmp_path / "shared")
    path = tmp_path / "recording.h5"
    path.write_bytes(BYTES)
    monkeypatch.setattr("os.replace", renamed)
    store.put(path, FILED.key)
    assert store.verified(FILED).read_bytes() == BYTES and not path.exists()
    assert [one.name for one in (tmp_path / "shared" / "recordings").iterdir()] == ["run.h5"]


def test_a_cut_upload_leaves_nothing_and_says_which_store_did_not_answer(
    remote: RemoteStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    def cut(*_: Any) -> None:
        raise ConnectionResetError("cut")

    monkeypatch.setattr(remote.files, "put_file", cut)
    with pytest.raises(StoreSilent, match="memory://bucket/rths did not answer: cut"):
        put(remote)
    monkeypatch.undo()
    assert remote.listed("recordings") == {}
    assert (remote.scratch("recordings") / "new").read_bytes() == BYTES  # what was not stored is not lost


def test_an_altered_local_copy_is_fetched_again_and_one_that_was_put_is_not_fetched(
    remote: RemoteStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(remote, sha256=SHA256)
    fetched: list[str] = []

    def fetch(key: str, target: Path) -> None:
        fetched.append(key)
        target.write_bytes(BYTES)

    monkeypatch.setattr(remote, "fetch", fetch)
    copy = remote.verified(FILED)
    assert fetched == []
    copy.write_bytes(b"altered")
    assert remote.verified(FILED).read_bytes() == BYTES and fetched == [FILED.key]


def test_local_copies_are_bounded_and_those_in_use_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = copies.Copies(tmp_path, limit=25)
    for name in ("a", "b", "c"):
        kept.of(name).write_bytes(b"0123456789")
    kept.trim()
    assert len(list(tmp_path.iterdir())) == 3  # used just now
    os.utime(kept.of("a"), (1, 1))
    os.utime(kept.of("b"), (2, 2))
    kept.used(kept.of("a"))
    kept.trim()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "c"]


def test_a_folder_follows_what_another_machine_stores_and_deletes(remote: RemoteStore, tmp_path: Path) -> None:
    other = RemoteStore("memory://bucket/rths", tmp_path / "other")
    for store in (remote, other):
        assert not list(store.folder("motions").glob("[!.]*"))
    (remote.folder("motions") / "one.npz").write_bytes(BYTES)
    remote.keep("motions", "one.npz")
    assert (other.folder("motions") / "one.npz").read_bytes() == BYTES
    remote.drop("motions", "one.npz")
    assert not (other.folder("motions") / "one.npz").exists() and not (remote.folder("motions") / "one.npz").exists()


def test_a_ground_motion_reaches_the_library_of_another_machine(remote: RemoteStore, tmp_path: Path) -> None:
    motion = Motion(name="mine", title="Mine", dt=0.01, acceleration=np.array([0.0, 1.0, 0.0]))
    StoredMotions(remote).add(motion)
    other = RemoteStore("memory://bucket/rths", tmp_path / "other")
    assert StoredMotions(other).get("mine").sha256 == motion.sha256
    StoredMotions(other).remove("mine")
    assert "mine" not in StoredMotions(remote).names()


@pytest.mark.parametrize("address", ["shared/rths", "file://host/rths", "s3:///rths", "s3://key:secret@bucket/rths"])
def test_an_address_that_names_no_store_is_refused(address: str, tmp_path: Path) -> None:
    with pytest.raises(RthsError, match=r"^store") as refused:
        opened(address, tmp_path)
    assert "secret" not in str(refused.value)


def test_a_store_of_an_unknown_kind_says_what_to_install(tmp_path: Path) -> None:
    with pytest.raises(RthsError, match="use file:// or s3://"):
        opened("nothing://bucket", tmp_path).listed("recordings")


def test_the_data_folder_is_the_store_unless_another_is_named(tmp_path: Path) -> None:
    assert store_of(Settings(data=tmp_path)).where == str(tmp_path)
    assert store_of(Settings(data=tmp_path, store="file:///shared/a%20b")).where == "/shared/a b"
