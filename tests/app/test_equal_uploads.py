"""Requests with equal content meet under one checksum: none removes a file that another one reads or has just stored."""

from __future__ import annotations

import hashlib
import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.config import Settings
from app.measured.raw_files import RawFiles
from app.store.filed import of_raw
from app.store.opening import store_of
from tests.engine import measurements as made

URL = "/api/v1/recordings"
UNREADABLE = b"\x00\x01 no measurements"


def uploaded(client: TestClient, raw: bytes, name: str = "sine.csv") -> Any:
    return client.post(f"{URL}/files", files={"file": (name, raw)})


def stored(settings: Settings) -> list[str]:
    return sorted(path.name for path in settings.measured.rglob("*") if path.is_file())


def test_equal_uploads_that_are_refused_each_get_their_reason(client: TestClient, settings: Settings) -> None:
    with ThreadPoolExecutor(4) as threads:
        answers = list(threads.map(lambda _: uploaded(client, UNREADABLE, "bad.h5"), range(8)))
    assert {answer.status_code for answer in answers} == {422}
    assert stored(settings) == []


def test_equal_uploads_that_are_good_leave_one_file(client: TestClient, settings: Settings) -> None:
    with ThreadPoolExecutor(4) as threads:
        answers = list(threads.map(lambda _: uploaded(client, made.csv()), range(6)))
    assert {answer.status_code for answer in answers} == {201}
    assert stored(settings) == [hashlib.sha256(made.csv()).hexdigest()]


def test_a_refused_batch_leaves_the_file_of_another_request(client: TestClient, settings: Settings) -> None:
    sha256 = uploaded(client, made.csv()).json()["sha256"]
    files = [("files", ("sine.csv", made.csv())), ("files", ("bad.csv", UNREADABLE))]
    mapping = made.mapping()
    mapping["channels"][0]["column"] = "no such column"
    answer = client.post(f"{URL}/batches", files=files, data={"mapping": json.dumps(mapping)})
    assert answer.status_code in (201, 422), answer.text
    assert stored(settings) == [sha256]


def test_a_removal_leaves_a_file_whose_row_came_meanwhile(client: TestClient, settings: Settings) -> None:
    sha256 = uploaded(client, made.csv()).json()["sha256"]
    raw_files = RawFiles(store_of(settings))
    with client.app.state.sessions() as session:  # type: ignore[attr-defined]
        raw_files.remove_unused(session, sha256)  # as a removal does that ends after the upload
    assert stored(settings) == [sha256]


def test_an_upload_whose_file_is_being_removed_is_asked_to_come_again(
    client: TestClient, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    sha256, store = hashlib.sha256(made.csv()).hexdigest(), store_of(settings)
    put = type(store).put

    def removed_at_once(self: Any, path: Path, key: str, sha256: str | None = None) -> None:
        put(self, path, key, sha256)
        self.discard(key)

    monkeypatch.setattr(type(store), "put", removed_at_once)
    answer = uploaded(client, made.csv())
    assert answer.status_code == 503 and "Retry-After" in answer.headers
    assert client.get(f"{URL}/files/{sha256}").status_code == 404 and not store.has(of_raw(sha256))
