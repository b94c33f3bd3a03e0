"""Recordings by REST: upload, preview, import, downloads, mappings used again, removal."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app import db
from app.config import Settings
from app.db import Base
from app.models import RawFile
from rths_engine.recordings.measured import Mapping
from rths_engine.recordings.opening import load
from tests.engine import measurements as made

URL = "/api/v1/recordings"
HALF_MADE = "*.tmp"


def upload(client: TestClient, raw: bytes = made.csv(), name: str = "sine.csv") -> Any:
    answer = client.post(f"{URL}/files", files={"file": (name, raw)})
    assert answer.status_code == 201, answer.text
    return answer.json()


def post(client: TestClient, path: str, file: str, mapping: Any, **more: Any) -> Any:
    return client.post(URL + path, json={"file": file, "mapping": mapping, **more})


def add(client: TestClient, raw: bytes = made.csv(), **mapping: Any) -> Any:
    answer = post(client, "", upload(client, raw)["sha256"], made.mapping(**mapping), imported_by="Ana")
    assert answer.status_code == 201, answer.text
    return answer.json()


def kept(settings: Settings) -> list[str]:
    """Names of all files of recordings."""
    return sorted(path.name for path in settings.measured.rglob("*") if path.is_file())


@pytest.mark.parametrize(
    ("raw", "name"),
    [
        (made.csv(), "C:\\lab\\sine.csv"),
        (made.json_nested(), "../../sine.json"),
        (made.matlab5(), "sine.mat"),
        (made.matlab73(), "sine.mat"),
        (made.hdf5(), "sine.h5"),
        (made.parquet(), "sine.parquet"),
    ],
    ids=["csv", "json", "matlab5", "matlab73", "hdf5", "parquet"],
)
def test_a_file_of_each_format_is_kept_and_imported_by_its_guess(
    client: TestClient, settings: Settings, raw: bytes, name: str
) -> None:
    sent = upload(client, raw, name)
    assert (sent["sha256"], sent["size"]) == (hashlib.sha256(raw).hexdigest(), len(raw))
    assert sent["filename"] == re.split(r"[/\\]", name)[-1]
    answer = post(client, "", sent["sha256"], sent["guess"])
    assert answer.status_code == 201, answer.text
    measured = load(settings.measured / f"{answer.json()['id']}.h5")
    assert measured.get("x_meas").max() == pytest.approx(25e-3, rel=1e-3)  # the peak lies between samples
    assert (measured.source, measured.source_sha256) == (sent["filename"], sent["sha256"])


def test_the_upload_tells_its_columns_and_why_each_was_taken_so(client: TestClient) -> None:
    sent = upload(client)
    disp = next(column for column in sent["columns"] if column["name"] == "Disp (mm)")
    assert (disp["samples"], disp["missing"]) == (1001, 0)
    assert disp["largest"] == pytest.approx(25, rel=1e-3) and disp["mean"] == pytest.approx(0, abs=1e-6)
    assert "by its name" in sent["reasons"]["Disp (mm)"]
    assert client.get(f"{URL}/files/{sent['sha256']}").json() == sent


def test_the_same_bytes_twice_are_one_raw_file(client: TestClient, settings: Settings) -> None:
    first, again = upload(client), upload(client, name="copy.csv")
    assert first["sha256"] == again["sha256"] and again["filename"] == "copy.csv"
    assert kept(settings) == [first["sha256"]]


def test_a_preview_shows_channels_in_shown_units_with_every_extreme_and_stores_nothing(
    client: TestClient, settings: Settings
) -> None:
    sent = upload(client)
    shown = post(client, "/preview", sent["sha256"], made.mapping()).json()
    by_key = {channel["key"]: channel for channel in shown["channels"]}
    assert {key: one["unit"] for key, one in by_key.items()} == {"x_meas.1": "mm", "v_meas.1": "mm/s", "f_meas.1": "kN"}
    disp = by_key["x_meas.1"]
    assert max(disp["values"]) == pytest.approx(disp["largest"]) and len(disp["time"]) == len(disp["values"])
    assert (shown["samples"], shown["dt_s"], shown["findings"]) == (1001, 0.005, [])
    assert kept(settings) == [sent["sha256"]]
    assert client.get(URL).json() == {"recordings": [], "total": 0}


def test_a_long_recording_is_decimated_to_its_extremes(client: TestClient) -> None:
    rows = [f"{0.001 * k:.3f},{1000 if k == 31_415 else k % 7}" for k in range(60_000)]
    sent = upload(client, "\n".join(["t_s,disp_mm", *rows]).encode())
    (channel,) = post(client, "/preview", sent["sha256"], sent["guess"]).json()["channels"]
    assert len(channel["values"]) < 3000
    assert channel["time"][channel["values"].index(1000)] == pytest.approx(31.415)


def test_a_finding_names_its_column_and_an_error_refuses_the_import(client: TestClient, settings: Settings) -> None:
    sent = upload(client)
    wrong = made.mapping()
    wrong["channels"][2]["reverse"] = True
    (error,) = [one for one in post(client, "/preview", sent["sha256"], wrong).json()["findings"] if one["severity"] == "error"]
    assert (error["channel"], error["column"]) == ("v_meas.1", "Vel (mm/s)")
    answer = post(client, "", sent["sha256"], wrong)
    assert answer.status_code == 422 and answer.json()["errors"][0]["where"] == "v_meas.1"
    assert kept(settings) == [sent["sha256"]] and client.get(URL).json()["total"] == 0


def test_a_warning_is_kept_with_the_recording(client: TestClient) -> None:
    mapping = made.mapping()
    mapping["channels"][3]["reverse"] = True  # the force supplies energy
    recording = post(client, "", upload(client)["sha256"], mapping).json()
    assert "supplies energy" in recording["warnings"][0]["problem"]


def test_an_import_by_yaml_is_the_import_by_json(client: TestClient) -> None:
    first = add(client)
    text = client.get(f"{URL}/{first['id']}/mapping.yaml").text
    second = post(client, "", first["raw_sha256"], text, name="by YAML").json()
    assert (second["mapping"], second["channels"]) == (first["mapping"], first["channels"])
    assert second["name"] == "by YAML"


def test_everything_of_a_recording_can_be_downloaded(client: TestClient, tmp_path: Path) -> None:
    recording = add(client, title="Sine of 25 mm")
    base = f"{URL}/{recording['id']}"
    whole = client.get(f"{base}/recording.h5").content
    assert (hashlib.sha256(whole).hexdigest(), len(whole)) == (recording["sha256"], recording["size"])
    (tmp_path / "one.h5").write_bytes(whole)
    assert load(tmp_path / "one.h5").title == recording["name"] == "Sine of 25 mm"
    raw = client.get(f"{base}/raw")
    assert raw.content == made.csv() and 'filename="sine.csv"' in raw.headers["content-disposition"]
    assert raw.headers["content-type"] == "application/octet-stream"  # never shown as a page
    assert Mapping.from_yaml(client.get(f"{base}/mapping.yaml").text) == Mapping.read(made.mapping(title="Sine of 25 mm"))
    channels = client.get(f"{base}/preview").json()["channels"]
    assert [one["key"] for one in channels] == ["x_meas.1", "v_meas.1", "f_meas.1"]


def test_the_list_is_newest_first_and_by_pages(client: TestClient) -> None:
    ids = [add(client)["id"] for _ in range(3)]
    listed = client.get(URL, params={"limit": 2}).json()
    assert ([one["id"] for one in listed["recordings"]], listed["total"]) == (ids[:0:-1], 3)
    assert [one["id"] for one in client.get(URL, params={"offset": 2}).json()["recordings"]] == ids[:1]
    one = client.get(f"{URL}/{ids[0]}").json()
    assert (one["rate_hz"], one["duration_s"], one["imported_by"]) == (200, 5, "Ana")


def test_an_earlier_mapping_is_offered_where_the_file_has_its_columns(client: TestClient) -> None:
    recording = add(client)
    add(client)  # by the same mapping
    other = b"t_s,position_mm\n" + b"".join(b"%d,%d\n" % (k, k % 9) for k in range(50))
    (offered,) = upload(client, made.csv(made.COLUMNS[:500]))["mappings"]
    assert offered["mapping"] == recording["mapping"]
    assert upload(client, other)["mappings"] == []
    assert [one["mapping"] for one in client.get(f"{URL}/mappings").json()["mappings"]] == [recording["mapping"]]


def test_a_removed_recording_is_gone_with_its_raw_file_unless_another_came_from_it(
    client: TestClient, settings: Settings
) -> None:
    first, second = add(client), add(client, start=1.0)
    assert client.delete(f"{URL}/{first['id']}").status_code == 204
    assert kept(settings) == sorted([f"{second['id']}.h5", second["raw_sha256"]])
    assert client.delete(f"{URL}/{second['id']}").status_code == 204
    assert kept(settings) == []
    assert client.get(f"{URL}/{first['id']}").status_code == 404
    assert client.get(f"{URL}/files/{first['raw_sha256']}").status_code == 404


@pytest.fixture
def study(settings: Settings) -> Iterator[sa.Table]:
    """A table that refers to recordings."""
    table = sa.Table("case_study", Base.metadata, sa.Column("recording", sa.ForeignKey("measured_recording.id")))
    engine = db.connect(settings.url)
    table.create(engine)
    yield table
    Base.metadata.remove(table)
    engine.dispose()


def test_a_recording_in_use_stays_and_says_what_uses_it(client: TestClient, settings: Settings, study: sa.Table) -> None:
    recording = add(client)
    engine = db.connect(settings.url)
    with engine.begin() as connection:
        connection.execute(sa.insert(study).values(recording=recording["id"]))
    answer = client.delete(f"{URL}/{recording['id']}")
    assert answer.status_code == 409 and "1 × case study" in answer.json()["detail"]
    assert len(kept(settings)) == 2
    with engine.begin() as connection:
        connection.execute(sa.delete(study))
    assert client.delete(f"{URL}/{recording['id']}").status_code == 204
    engine.dispose()


def test_a_file_from_which_nothing_was_imported_goes_after_a_day(client: TestClient, settings: Settings) -> None:
    used, unused = add(client), upload(client, made.json_nested(), "sine.json")
    engine = db.connect(settings.url)
    with db.unit_of_work(db.sessions(engine)) as session:
        session.execute(sa.update(RawFile).values(uploaded_at=datetime.now(UTC) - timedelta(days=2)))
    engine.dispose()
    new = upload(client, made.matlab5(), "sine.mat")
    assert kept(settings) == sorted([f"{used['id']}.h5", used["raw_sha256"], new["sha256"]])
    answer = post(client, "", unused["sha256"], unused["guess"])
    assert answer.status_code == 404 and "Upload it" in answer.json()["detail"]


def test_a_file_that_is_gone_from_the_folder_is_told_and_comes_back_by_uploading(
    client: TestClient, settings: Settings
) -> None:
    raw = made.csv(made.COLUMNS[:321])  # nothing of it is kept in memory
    sent = upload(client, raw)
    other = [upload(client, made.csv(made.COLUMNS[:count])) for count in (400, 500)]
    (settings.measured / "raw" / sent["sha256"]).unlink()
    answer = post(client, "/preview", sent["sha256"], sent["guess"])
    assert answer.status_code == 409 and "upload it again" in answer.json()["detail"]
    upload(client, raw)
    assert post(client, "/preview", sent["sha256"], sent["guess"]).status_code == 200
    assert len(other) == 2


def test_the_pages_list_recordings_and_show_one_and_say_where_there_is_none(client: TestClient) -> None:
    assert "There is no imported recording yet" in client.get("/recordings").text
    recording = add(client, title="Sine <b>of</b> 25 mm")
    assert "Sine &lt;b&gt;of&lt;/b&gt; 25 mm" in client.get("/recordings").text
    assert "Measured displacement, station 1" in client.get(f"/recordings/{recording['id']}").text
    assert "Page 9 is empty: there are only 1 recordings" in client.get("/recordings", params={"page": 9}).text
    for path, status in (("/recordings/nothing", 404), ("/recordings?page=0", 422)):
        answer = client.get(path)
        assert answer.status_code == status and answer.headers["content-type"].startswith("text/html")
