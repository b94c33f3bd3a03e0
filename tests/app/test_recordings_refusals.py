"""What is sent for recordings and can't be taken: a problem that says why, nothing kept, never a server error."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, app_of
from tests.app.test_recordings_api import URL, add, kept, post, upload
from tests.engine import measurements as made

EXAMPLES = hypothesis_settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
NOBODY = "0" * 64


def changed(**channel: Any) -> dict[str, Any]:
    """The mapping with its displacement's channel changed."""
    data = made.mapping()
    data["channels"][1].update(channel)
    return data


@pytest.mark.parametrize(
    ("raw", "name"),
    [
        (b"", "empty.csv"),
        (b"   \n", "blank.csv"),
        (b"a letter to a friend\n" * 20, "letter.txt"),
        (b"\x89HDF\r\n\x1a\n" + b"\0" * 100, "broken.h5"),
        (b"MATLAB 5.0 MAT-file" + b"\0" * 200, "broken.mat"),
        (b"PAR1" + b"\0" * 50 + b"PAR1", "broken.parquet"),
        (b"[" * 100_000, "deep.json"),
    ],
)
def test_a_file_that_cannot_be_read_is_refused_and_not_kept(
    client: TestClient, settings: Settings, raw: bytes, name: str
) -> None:
    answer = client.post(f"{URL}/files", files={"file": (name, raw)})
    assert answer.status_code == 422, answer.text
    assert answer.json()["errors"][0]["problem"]
    assert kept(settings) == []


def test_a_file_that_is_too_large_is_refused_by_the_bound_of_the_configuration(settings: Settings) -> None:
    small = replace(settings, measurements_limit=2_000_000)

    def endless() -> Iterator[bytes]:
        yield b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.csv"\r\n\r\n'
        for _ in range(20):
            yield b"0.1\n" * 250_000

    with TestClient(create_app(small), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        declared = client.post(f"{URL}/files", files={"file": ("a.csv", b"0.1\n" * 600_000)})
        counted = client.post(f"{URL}/files", content=endless(), headers={"content-type": "multipart/form-data; boundary=b"})
    for answer in (declared, counted):
        assert answer.status_code == 413 and answer.headers["content-type"] == "application/problem+json"
        assert "2 MB" in answer.json()["detail"]
    assert kept(settings) == []


def test_a_file_larger_than_other_requests_may_be_is_taken(client: TestClient, settings: Settings) -> None:
    small = replace(settings, upload_limit=20_000)
    with TestClient(create_app(small), ADDRESS, client=HERE, raise_server_exceptions=False) as one:
        assert upload(one)["size"] > 20_000


@pytest.mark.parametrize(
    ("mapping", "where", "message"),
    [
        (changed(unit="furlong"), "mapping.channels.1.unit", "not a known unit"),
        (changed(unit="V"), "mapping.channels.1.gain", "give a gain"),
        (changed(unit=""), "mapping.channels.1.unit", "choose the unit"),
        (changed(unit="µstr"), "mapping.channels.1.unit", "the unit 'µstr' is not known"),
        (changed(column="Desp (mm)"), "mapping.channels.1", "Disp (mm)"),
        (changed(label="\0"), "mapping.channels.1.label", "can't be stored"),
        (changed(gain="1e999"), "mapping.channels.1", "finite"),
        (changed(role="f_meas", unit="kN"), "mapping", "mapped twice"),
        (made.mapping(start=3.0, stop=2.0), "mapping", "after start"),
        (made.mapping(start=-1e308, stop=1e308, target_rate=1e-310), "mapping.start, stop and target_rate", "needs at least 8"),
        (made.mapping(start=1e308), "mapping", "out of range"),
        (changed(rate=1e-310), "mapping.rate", "needs a time step"),
        (made.mapping(start=4.999), "mapping.start, stop and target_rate", "needs at least 8"),
        (made.mapping(target_rate=1e-9), "mapping.start, stop and target_rate", "needs at least 8"),
        ("channels: [", "mapping", ""),
        ("just words", "mapping", "not a mapping of fields"),
        ({}, "mapping.channels", ""),
    ],
)
@pytest.mark.parametrize("path", ["/preview", ""])
def test_a_mapping_that_does_not_fit_is_told_by_its_place_and_nothing_is_stored(
    serving: TestClient, path: str, mapping: Any, where: str, message: str
) -> None:
    sent = upload(serving)
    answer = post(serving, path, sent["sha256"], mapping)
    assert answer.status_code == 422, answer.text
    assert answer.json()["errors"][0]["where"] == where and message in answer.json()["detail"]
    assert kept(app_of(serving).state.settings) == [sent["sha256"]] and serving.get(URL).json()["total"] == 0


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "message"),
    [
        ("POST", "/preview", {"file": NOBODY, "mapping": {}}, 404, "no uploaded file"),
        ("POST", "", {"file": "../secret", "mapping": {}}, 422, "file"),
        ("POST", "", {"file": NOBODY, "mapping": 3}, 422, "mapping"),
        ("POST", "", {"file": NOBODY, "mapping": {}, "name": "\ud800"}, 422, ""),
        ("POST", "", {"file": NOBODY, "mapping": {}, "names": ""}, 422, "names"),
        ("GET", "?limit=0", None, 422, "limit"),
        ("GET", "/nothing", None, 404, "no recording nothing"),
        ("GET", "/nothing/preview", None, 404, "no recording"),
        ("GET", "/nothing/raw", None, 404, "no recording"),
        ("GET", "/nothing/recording.h5", None, 404, "no recording"),
        ("GET", "/nothing/mapping.yaml", None, 404, "no recording"),
        ("GET", "/files/nothing", None, 404, "no uploaded file"),
        ("DELETE", "/nothing", None, 404, "no recording"),
    ],
)
def test_a_request_that_cannot_be_taken_says_why(
    serving: TestClient, method: str, path: str, body: Any, status: int, message: str
) -> None:
    answer = serving.request(method, URL + path, content=json.dumps(body), headers={"content-type": "application/json"})
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json" and message in answer.json()["detail"]


def test_a_recording_whose_file_is_damaged_or_missing_says_so(client: TestClient, settings: Settings) -> None:
    recording = add(client)
    path = settings.measured / f"{recording['id']}.h5"
    path.write_bytes(path.read_bytes()[:2000])
    answer = client.get(f"{URL}/{recording['id']}/preview")
    assert answer.status_code == 409 and "has 2000 bytes; its row states" in answer.json()["detail"]
    path.unlink()
    assert client.get(f"{URL}/{recording['id']}/recording.h5").status_code == 409


@EXAMPLES
@given(
    name=st.sampled_from(["number", "unit", "gain", "offset", "reverse", "label", "time", "rate", "column", "role"]),
    value=st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=30) | st.sampled_from(["1e300", "1e-320"]),
)
def test_no_value_in_a_mapping_causes_a_server_error(client: TestClient, name: str, value: Any) -> None:
    body = {"file": upload(client)["sha256"], "mapping": changed(**{name: value})}
    answer = client.post(f"{URL}/preview", content=json.dumps(body), headers={"content-type": "application/json"})
    assert answer.status_code in {200, 400, 422}, answer.text


@EXAMPLES
@given(
    raw=st.binary(max_size=200) | st.text(alphabet='0123456789.,;-e \nabc"[]{}:', max_size=200).map(str.encode),
    name=st.text(max_size=20),
)
def test_no_file_causes_a_server_error(client: TestClient, raw: bytes, name: str) -> None:
    answer = client.post(f"{URL}/files", files={"file": (name or "file", raw)})
    assert answer.status_code in {201, 422}, answer.text
    if answer.status_code == 201 and (guessed := answer.json()["guess"]):
        assert post(client, "/preview", answer.json()["sha256"], guessed).status_code in {200, 422}
