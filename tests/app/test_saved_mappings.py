"""Mappings saved under a name: proposed for files of the same layout, listed, renamed and deleted."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from rths_engine.recordings.measured import Mapping, fingerprint, read
from tests.app.test_recordings_api import upload
from tests.engine import measurements as made

URL = "/api/v1/mappings"


def csv(heading: str = "t (s),Disp (mm),Force (kN)", factor: float = 1.0) -> bytes:
    rows = (f"{k / 100},{factor * (k % 50)},{factor * (k % 25)}" for k in range(200))
    return "\n".join([heading, *rows]).encode()


def save(client: TestClient, sent: Any, name: str = "Damper rig", **changes: Any) -> Any:
    return client.post(URL, json={"file": sent["sha256"], "mapping": {**sent["guess"], **changes}, "name": name})


def test_a_saved_mapping_is_proposed_for_a_file_of_the_same_layout_only(client: TestClient) -> None:
    first = upload(client, csv(), "first.csv")
    assert first["saved"] == []
    answer = save(client, first, title="Test of Monday", test="specimen")
    assert answer.status_code == 201, answer.text
    saved = answer.json()
    assert (saved["name"], saved["layout"], saved["mapping"]["title"]) == ("Damper rig", first["layout"], "")
    assert saved["columns"] == [{"name": one["name"], "unit": one["unit"]} for one in first["columns"]]
    again = upload(client, csv(factor=2.0), "second.csv")
    assert [one["id"] for one in again["saved"]] == [saved["id"]]
    for heading in ("t (s),Disp (m),Force (kN)", "t (s),Force (kN),Disp (mm)", "t (s),Disp (mm),Load (kN)"):
        assert upload(client, csv(heading), "other.csv")["saved"] == [], heading


def test_saved_mappings_are_listed_renamed_read_as_yaml_and_deleted(client: TestClient) -> None:
    sent = upload(client, csv())
    one, other = save(client, sent).json(), save(client, sent, "Brace rig").json()
    assert [each["name"] for each in client.get(URL).json()["mappings"]] == ["Brace rig", "Damper rig"]
    renamed = client.patch(f"{URL}/{one['id']}", json={"name": " Damper rig, 100 kN "})
    assert renamed.json() == client.get(f"{URL}/{one['id']}").json() == {**one, "name": "Damper rig, 100 kN"}
    assert client.patch(f"{URL}/{one['id']}", json={"name": "Damper rig, 100 kN"}).status_code == 200
    text = client.get(f"{URL}/{one['id']}/mapping.yaml").text
    assert Mapping.from_yaml(text) == Mapping.read(one["mapping"])
    assert client.delete(f"{URL}/{one['id']}").status_code == 204
    assert [each["id"] for each in client.get(URL).json()["mappings"]] == [other["id"]]


@pytest.mark.parametrize("method", ["get", "patch", "delete"])
def test_a_mapping_that_is_not_there_is_not_found(serving: TestClient, method: str) -> None:
    more: dict[str, Any] = {"json": {"name": "a"}} if method == "patch" else {}
    assert getattr(serving, method)(f"{URL}/nothing", **more).status_code == 404


def test_a_name_that_is_taken_or_empty_is_refused(client: TestClient) -> None:
    sent = upload(client, csv())
    one = save(client, sent).json()
    again = save(client, sent, " Damper rig ")
    assert again.status_code == 409 and "named Damper rig already" in again.json()["detail"]
    other = save(client, sent, "Brace rig").json()
    assert client.patch(f"{URL}/{other['id']}", json={"name": one["name"]}).status_code == 409
    for name in ("", "   "):
        assert save(client, sent, name).status_code == 422
        assert client.patch(f"{URL}/{one['id']}", json={"name": name}).status_code == 422


def test_a_mapping_that_is_incomplete_or_does_not_fit_its_file_is_not_saved(client: TestClient) -> None:
    sent = upload(client, csv("t (s),Disp,Force (kN)"))
    (issue,) = save(client, sent).json()["errors"]
    assert issue["where"] == "mapping.channels.1.unit" and "choose the unit" in issue["problem"]
    channels = [{"column": "Load", "role": "f_meas", "unit": "kN"}]
    (issue,) = save(client, sent, channels=channels).json()["errors"]
    assert "does not have this column" in issue["problem"]
    assert client.get(URL).json() == {"mappings": []}


def test_mappings_are_saved_in_a_data_folder_of_an_earlier_version(earlier: TestClient) -> None:
    sent = upload(earlier, csv())
    assert save(earlier, sent).status_code == 201
    assert [one["name"] for one in upload(earlier, csv(factor=3.0))["saved"]] == ["Damper rig"]


def test_the_layout_is_format_names_and_units_but_no_numbers() -> None:
    layouts = {fingerprint(read(csv(factor=factor), "a.csv")) for factor in (1.0, 2.0)}
    assert len(layouts) == 1
    assert fingerprint(read(made.matlab5(), "sine.mat")) not in layouts


def test_an_upload_shows_header_statements_first_rows_and_doubts(client: TestClient) -> None:
    header = "RECORD\nTITLE\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  200, DT=   .0100 SEC\n"
    rows = "\n".join(" ".join(f"{0.001 * (k + j):.6f}" for j in range(5)) for k in range(0, 200, 5))
    sent = upload(client, (header + rows).encode(), "record.AT2")
    assert sent["header"].splitlines()[3] == "NPTS=  200, DT=   .0100 SEC"
    (stated,) = sent["statements"]
    assert (stated["what"], stated["stated"], stated["read"], stated["agrees"]) == ("number of samples", 200, 200, True)
    assert sent["first_rows"][:3] == [[0.0], [0.001], [0.002]] and len(sent["first_rows"]) == 8
    assert sent["columns"][0]["dt_s"] == 0.01 and sent["columns"][0]["quantity"] == "acceleration"
    unsure = upload(client, csv("t (s),Disp,Force (kN)"))
    assert unsure["doubtful"] == ["Disp"]
    assert unsure["first_rows"][1] == [0.01, 1.0, 1.0]


def test_a_part_of_a_long_recording_is_shown_with_every_sample(client: TestClient) -> None:
    rows = [f"{0.001 * k:.3f},{k % 97}" for k in range(60_000)]
    sent = upload(client, "\n".join(["t_s,disp_mm", *rows]).encode())
    asked = {"file": sent["sha256"], "mapping": sent["guess"], "from_s": 31.0, "to_s": 31.099}
    shown = client.post("/api/v1/recordings/preview", json=asked).json()
    (channel,) = shown["channels"]
    assert channel["samples"] == len(channel["values"]) == 100 and shown["samples"] == 60_000
    assert channel["values"] == [k % 97 for k in range(31_000, 31_100)]
    recording = client.post("/api/v1/recordings", json={"file": sent["sha256"], "mapping": sent["guess"]}).json()
    (kept,) = client.get(f"/api/v1/recordings/{recording['id']}/preview?from_s=31&to_s=31.099").json()["channels"]
    assert kept["values"] == channel["values"]
    nothing = client.get(f"/api/v1/recordings/{recording['id']}/preview?from_s=99").json()["channels"][0]
    assert (nothing["values"], nothing["samples"]) == ([], 0)


def test_a_refused_line_is_shown_with_its_neighbours(client: TestClient) -> None:
    raw = csv().replace(b"0.05,5.0,5.0", b"0.05,5.0,5.0\ncable loose")
    answer = client.post("/api/v1/recordings/files", files={"file": ("rows.csv", raw)})
    (issue,) = answer.json()["errors"]
    assert issue["where"] == "line 8"
    assert [line["text"] for line in issue["lines"]][1:4] == ["0.05,5.0,5.0", "cable loose", "0.06,6.0,6.0"]
