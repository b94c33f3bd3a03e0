"""Many files by one mapping over REST: nothing is lost when one file fails, and nothing is written for what is refused."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from app.config import Settings
from app.measured import batches
from app.measured.batch_rows import BatchRows
from rths_engine.recordings.measured import Mapping, mapping_yaml
from rths_engine.recordings.opening import load
from tests.engine import batch_files as made

URL = "/api/v1/recordings/batches"
YAML = mapping_yaml.write(Mapping.read(made.mapping()))


def post(client: TestClient, files: dict[str, bytes], mapping: str = YAML, **form: Any) -> Any:
    return client.post(URL, files=[("files", one) for one in files.items()], data={"mapping": mapping, **form})


def imported(client: TestClient, files: dict[str, bytes], mapping: str = YAML, **form: Any) -> Any:
    answer = post(client, files, mapping, **form)
    assert answer.status_code == 201, answer.text
    return answer.json()


def stored(settings: Settings) -> set[str]:
    """Names of the recordings and of the raw files in the data folder."""
    return {path.name for path in settings.measured.rglob("*") if path.is_file()}


def test_a_zip_of_fifty_files_is_imported_by_one_mapping_with_a_table(client: TestClient, settings: Settings) -> None:
    batch = imported(client, {"tests.zip": made.zipped(made.fifty())}, imported_by="Ana")
    assert (batch["imported"], batch["refused"], batch["reference"], batch["imported_by"]) == (47, 3, "run00.csv", "Ana")
    rows = {row["file"]: row for row in batch["rows"]}
    assert list(rows) == sorted(made.fifty())
    assert {name for name, row in rows.items() if row["recording"] is None} == {"run11.csv", "run17.csv", "run31.csv"}
    assert rows["run31.csv"]["reasons"][0]["where"] == "line 92"
    assert [line["text"] for line in rows["run31.csv"]["reasons"][0]["lines"]][2] == "cable loose"
    assert rows["run23.csv"]["differences"][0]["text"] == "sampling rate: 50 Hz; in the other files 100 Hz"
    recording = client.get(f"/api/v1/recordings/{rows['run08.csv']['recording']}").json()
    assert (recording["name"], recording["filename"]) == ("run08", "run08.csv")
    measured = load(settings.measured / f"{recording['id']}.h5")
    np.testing.assert_allclose(measured.get("f_meas", 1), 1e3 * made.signals(8)["Force (kN)"], rtol=1e-8)
    assert client.get(f"/api/v1/recordings/{recording['id']}/raw").content == made.file(8)
    assert client.get("/api/v1/recordings").json()["total"] == 47
    assert client.get(f"{URL}/{batch['id']}").json() == batch
    (listed,) = client.get(URL).json()["batches"]
    assert listed["id"] == batch["id"] and "rows" not in listed


def test_the_table_is_given_as_csv(client: TestClient) -> None:
    batch = imported(client, {"tests.zip": made.zipped(made.fifty())})
    answer = client.get(f"{URL}/{batch['id']}/table.csv")
    assert answer.headers["content-type"].startswith("text/csv")
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    assert [row["file"] for row in rows] == sorted(made.fifty())
    assert (rows[11]["result"], rows[11]["recording"]) == ("refused", "")
    assert (rows[12]["result"], rows[12]["recording"]) == ("imported", batch["rows"][12]["recording"])


def test_several_files_are_imported_by_a_mapping_in_json_and_a_refused_one_can_be_opened_alone(client: TestClient) -> None:
    files = {made.name(number): made.file(number) for number in (0, 1, 2, 11)}
    batch = imported(client, files, json.dumps(made.mapping(title="Damper")))
    assert (batch["imported"], batch["refused"]) == (3, 1)
    refused = batch["rows"][3]
    assert "does not have this column" in refused["reasons"][0]["problem"]
    sent = client.get(f"/api/v1/recordings/files/{refused['sha256']}").json()
    assert [column["name"] for column in sent["columns"]] == ["Time (s)", "Disp (mm)", "Force (N)"]
    names = [one["name"] for one in client.get("/api/v1/recordings").json()["recordings"]]
    assert names == ["Damper, run02", "Damper, run01", "Damper, run00"]


def test_what_is_refused_leaves_no_file_behind(client: TestClient, settings: Settings) -> None:
    damaged = {"a.csv": b"\0\1\2", "b.csv": made.file(31)}
    batch = imported(client, damaged)
    assert batch["imported"] == 0 and all(row["reasons"] for row in batch["rows"])
    assert stored(settings) == set()
    for files, mapping in (({"a.csv": made.file(1)}, "channels: ["), ({"a.csv": made.file(1), "b.zip": b"1,2"}, YAML)):
        assert post(client, files, mapping).status_code == 422
    assert stored(settings) == set() and client.get(URL).json()["total"] == 1


def test_a_raw_file_that_a_recording_needs_survives_a_batch_that_refuses_it(client: TestClient, settings: Settings) -> None:
    first = imported(client, {"a.csv": made.file(1)})
    mapping = made.mapping()
    mapping["channels"][1]["column"] = "Travel"
    assert imported(client, {"a.csv": made.file(1)}, json.dumps(mapping))["imported"] == 0
    (row,) = first["rows"]
    assert client.get(f"/api/v1/recordings/{row['recording']}/raw").content == made.file(1)
    assert stored(settings) == {f"{row['recording']}.h5", row["sha256"]}


def test_a_batch_that_fails_halfway_leaves_nothing(
    client: TestClient, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: Any) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(BatchRows, "add", fail)
    assert post(client, {"tests.zip": made.zipped({made.name(k): made.file(k) for k in range(3)})}).status_code == 500
    assert stored(settings) == set() and client.get("/api/v1/recordings").json()["total"] == 0


@pytest.mark.parametrize(
    ("files", "told"),
    [
        ({"t.zip": made.zipped({f"{k}.csv": b"1" for k in range(5)})}, "contains more than 4 files"),
        ({f"{k}.csv": b"1" for k in range(5)}, "are more than 4 files"),
        ({"t.zip": made.zipped({"a.csv": bytes(40_000), "b.csv": bytes(40_000)})}, "unpacks to more than 0.05 MB"),
        ({"t.zip": made.zipped({"../../../a.csv": made.file(1)})}, "leads out of the archive"),
        ({"t.zip": b"PK\3\4"}, "is not a complete ZIP archive"),
    ],
)
def test_too_much_and_harmful_archives_are_refused_as_a_whole(
    client: TestClient, settings: Settings, files: dict[str, bytes], told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(batches, "MOST_FILES", 4)
    monkeypatch.setattr("app.measured.dependency.UNPACKED", 0.05e6 / settings.measurements_limit)
    outside = set(Path(settings.data).parent.iterdir())
    answer = post(client, files)
    assert answer.status_code == 422 and told in answer.json()["detail"]
    assert stored(settings) == set() and set(Path(settings.data).parent.iterdir()) == outside


def test_an_archive_in_an_archive_is_refused_alone(client: TestClient) -> None:
    inner = made.zipped({"a.csv": made.file(1)})
    batch = imported(client, {"t.zip": made.zipped({"inner.zip": inner, "b.csv": made.file(1)})})
    assert [row["imported"] for row in batch["rows"]] == [True, False]
    assert "is a ZIP archive" in batch["rows"][1]["reasons"][0]["problem"]


def test_a_deleted_recording_is_null_in_its_table(client: TestClient) -> None:
    batch = imported(client, {"a.csv": made.file(1), "b.csv": made.file(2)})
    assert client.delete(f"/api/v1/recordings/{batch['rows'][0]['recording']}").status_code == 204
    again = client.get(f"{URL}/{batch['id']}").json()
    assert [row["recording"] for row in again["rows"]] == [None, batch["rows"][1]["recording"]]
    assert [row["imported"] for row in again["rows"]] == [True, True]


def test_the_mapping_is_trusted_against_the_units_of_most_files_only_where_asked(client: TestClient) -> None:
    mapping = made.mapping()
    mapping["channels"][2]["unit"] = "N"
    files = {made.name(number): made.file(number) for number in range(4)}
    assert imported(client, files, json.dumps(mapping))["imported"] == 0
    trusted = imported(client, files, json.dumps(mapping), trust_mapping="true")
    assert trusted["imported"] == 4 and trusted["trust_mapping"] is True
    assert all("the file states kN" in row["warnings"][0]["problem"] for row in trusted["rows"])


def test_a_batch_that_is_not_there_is_not_found(client: TestClient) -> None:
    assert client.get(f"{URL}/nothing").status_code == 404
    assert client.get(f"{URL}/nothing/table.csv").status_code == 404


def test_a_batch_is_imported_in_a_data_folder_of_an_earlier_version(earlier: TestClient) -> None:
    assert imported(earlier, {"a.csv": made.file(1)})["imported"] == 1
