"""Comparisons by REST: differing fields, measures with differences, words for what an overlay hides, signals, refusals."""

from __future__ import annotations

import json
import struct
from typing import Any

import httpx
import numpy as np
import pytest

from tests.browser.service import Service

URL = "/api/v1/compare"


def driven(service: Service, frequency: float, **changes: Any) -> dict[str, Any]:
    """A test of a specimen under a sine of 2 s."""
    shape = {"kind": "sine", "frequency": frequency, "cycles": 2 * frequency, "ramps": 0.5}
    plan = service.plan("specimen-mr-damper", drive={"amplitude": 0.01, "shape": shape}, **changes)
    return {**plan, "template": None}


def done(service: Service, plan: dict[str, Any]) -> str:
    run: str = service.post("/runs", {"plan": plan})["runs"][0]["id"]
    service.wait(run, "completed")
    return f"run:{run}"


@pytest.fixture(scope="module")
def slow(service: Service) -> str:
    return done(service, driven(service, 1.0, name="Slow"))


@pytest.fixture(scope="module")
def fast(service: Service) -> str:
    return done(service, driven(service, 2.0, name="Fast", notes="Twice as fast"))


@pytest.fixture(scope="module")
def hybrids(service: Service) -> list[str]:
    limits = {"displacement": 0.2, "velocity": 0.45, "force": 1e6}
    plan = service.plan("two-storeys", duration=1.0)
    second = {**plan, "stations": [plan["stations"][0], {**plan["stations"][1], "limits": limits}]}
    return [done(service, plan), done(service, second)]


@pytest.fixture(scope="module")
def imported(service: Service) -> str:
    """Measurements of 100 Hz from 5 s on: command, displacement and force of a sine of 1 Hz."""
    t = 5 + np.arange(200) / 100
    x = 10 * np.sin(2 * np.pi * (t - 5))
    rows = "".join(f"{a:.3f},{b:.6f},{0.9 * b:.6f},{3 * b:.6f}\n" for a, b in zip(t, x, strict=True))
    text = f"time (s),command (mm),displacement (mm),force (kN)\n{rows}"
    sent = service.http.post("/api/v1/recordings/files", files={"file": ("sine.csv", text)}).json()
    channels = [
        {"column": "time (s)", "role": "t", "unit": "s"},
        {"column": "command (mm)", "role": "x_cmd", "number": 1, "unit": "mm"},
        {"column": "displacement (mm)", "role": "x_meas", "number": 1, "unit": "mm"},
        {"column": "force (kN)", "role": "f_meas", "number": 1, "unit": "kN"},
    ]
    mapping = {"schema": "rths-mapping/1", "test": "specimen", "channels": channels}
    added = service.post("/recordings", {"file": sent["sha256"], "mapping": mapping, "name": "Sine of the laboratory"})
    return f"recording:{added['id']}"


def compare(service: Service, *items: str, **more: Any) -> dict[str, Any]:
    found: dict[str, Any] = service.http.get(URL, params={"items": ",".join(items), **more}).raise_for_status().json()
    return found


def about(found: dict[str, Any], topic: str) -> str:
    return " ".join(note["sentence"] for note in found["notes"] if note["about"] == topic)


def test_only_the_fields_that_differ_are_listed_and_excitations_that_differ_are_said(
    service: Service, slow: str, fast: str
) -> None:
    found = compare(service, slow, fast)
    assert [one["path"] for one in found["fields"]] == ["drive.shape.frequency", "drive.shape.cycles", "notes"]
    frequency = found["fields"][0]
    assert (frequency["texts"], frequency["unit"], frequency["differs"]) == (["1", "2"], "Hz", [False, True])
    labels = [one["label"] for one in found["items"]]
    said = f"The excitations differ: Drive: Shape: Frequency is 1 Hz in {labels[0]}, 2 Hz in {labels[1]};"
    assert about(found, "excitation").startswith(said)
    assert compare(service, fast, slow, reference=slow)["fields"][0]["differs"] == [True, False]


def test_measures_have_differences_to_the_reference(service: Service, hybrids: list[str]) -> None:
    found = compare(service, *hybrids)
    assert [one["path"] for one in found["fields"]] == ["stations.1.limits.velocity"]
    assert not about(found, "excitation")
    mte = next(one for one in found["measures"] if one["key"] == "mte_mm" and one["where"] == "Station 2")
    assert mte["unit"] == "mm" and mte["values"][0] == mte["values"][1] > 0
    assert mte["differences"] == [None, {"absolute": 0.0, "percent": 0.0}]
    assert {one["where"] for one in found["measures"]} == {"Station 1", "Station 2", "Floor 1", "Floor 2", "Whole test"}


def test_an_imported_recording_is_compared_and_what_it_lacks_is_said(service: Service, slow: str, imported: str) -> None:
    found = compare(service, slow, imported)
    run, recording = (one["label"] for one in found["items"])
    assert about(found, "plan") == f"{recording} has no plan: it was imported."
    assert about(found, "sampling").startswith(f"The sampling rates differ: 1024 Hz in {run}, 100 Hz in {recording}.")
    starts = f"0 s in {run}, 5 s in {recording}"
    assert about(found, "start") == f"The first samples are at different times: {starts}. No curve is shifted."
    assert f"the samples of {run} and {recording} have no time in common" in about(found, "excitation")
    assert about(found, "computed").startswith(f"The tracking error and tracking indicator of {recording}")
    stroke = next(one for one in found["measures"] if one["key"] == "peak_stroke_mm")
    assert stroke["values"][1] == pytest.approx(9.0, rel=1e-3)
    assert "Adaptation" in about(found, "channels") or "adaptation" in about(found, "channels")


def test_recorded_excitations_are_compared_where_there_is_no_plan(service: Service, imported: str) -> None:
    rows = "".join(f"{5 + k / 100:.3f},{5 * np.sin(k / 100 * 4 * np.pi):.6f}\n" for k in range(200))
    text = f"time (s),displacement (mm)\n{rows}"
    sent = service.http.post("/api/v1/recordings/files", files={"file": ("other.csv", text)}).json()
    channels = [{"column": 1, "role": "t", "unit": "s"}, {"column": 2, "role": "x_meas", "number": 1, "unit": "mm"}]
    mapping = {"schema": "rths-mapping/1", "test": "specimen", "channels": channels}
    other = service.post("/recordings", {"file": sent["sha256"], "mapping": mapping})["id"]
    found = compare(service, imported, f"recording:{other}")
    assert "its strongest frequency is 2 Hz, that of " in about(found, "excitation")
    assert "1 Hz" in about(found, "excitation")
    assert found["fields"] == []
    assert f"{found['items'][1]['label']} has no command displacement (x_cmd.1)" in about(found, "channels")


def test_kinds_of_test_and_numbers_of_stations_that_differ_are_said(service: Service, slow: str, hybrids: list[str]) -> None:
    found = compare(service, hybrids[0], slow)
    assert about(found, "test").startswith("The kinds of test differ: Real-time hybrid simulation in Run")
    assert about(found, "stations").startswith("The numbers of stations differ: 2 in Run")
    assert about(found, "duration").startswith("The durations differ: 1.006 s in Run")


def series(body: bytes) -> list[dict[str, Any]]:
    """The series of the binary body, each with its values."""
    length = struct.unpack_from("<I", body)[0]
    found: list[dict[str, Any]] = json.loads(body[4 : 4 + length])["series"]
    values = np.frombuffer(body, "<f4", offset=4 + length)
    at = 0
    for one in found:
        one["values"] = values[at : at + one["count"]]
        at += one["count"]
    assert at == len(values)
    return found


def test_signals_keep_extremes_and_a_part_of_the_time_keeps_its_samples(service: Service, slow: str, imported: str) -> None:
    query: dict[str, Any] = {"items": [slow, imported], "points": 50}
    found = series(service.http.get(f"{URL}/signals", params=query).raise_for_status().content)
    command = next(one for one in found if (one["item"], one["role"], one["form"]) == (0, "x_cmd", "envelope"))
    assert command["count"] == 100 and command["values"].max() == pytest.approx(10, rel=1e-3)
    assert {one["role"] for one in found if one["item"] == 1} == {"x_cmd", "x_meas", "f_meas", "error", "ti"}
    error = next(one for one in found if (one["item"], one["role"]) == (1, "error"))
    assert np.abs(error["values"]).max() == pytest.approx(1, rel=1e-2)
    part = series(service.http.get(f"{URL}/signals", params={**query, "from_s": 0.5, "to_s": 0.52}).content)
    command = next(one for one in part if (one["item"], one["role"], one["form"]) == (0, "x_cmd", "envelope"))
    assert command["step_s"] == 1 / 1024 and 0.496 < command["start_s"] <= 0.5
    assert command["values"][0] == pytest.approx(10 * np.sin(2 * np.pi * command["start_s"]), abs=0.02)


def refused(service: Service, items: str, **more: Any) -> httpx.Response:
    return service.http.get(URL, params={"items": items, **more})


def test_what_cannot_be_compared_is_refused_with_its_reason(service: Service, slow: str) -> None:
    one = refused(service, slow)
    assert one.status_code == 422 and "needs 2 to 20 items; the number given is 1" in one.json()["detail"]
    many = refused(service, ",".join(f"run:{k}" for k in range(21)))
    assert many.status_code == 422 and "the number given is 21" in many.json()["detail"]
    unknown = refused(service, f"{slow},run:none")
    assert (unknown.status_code, unknown.json()["detail"]) == (404, "There is no run none.")
    assert refused(service, f"{slow},recording:none").status_code == 404
    wrong = refused(service, f"{slow},table:3")
    assert wrong.status_code == 422 and wrong.json()["errors"][0]["where"] == "items.1"
    assert "is given twice" in refused(service, f"{slow},{slow}").json()["detail"]
    assert "is not one of the items" in refused(service, f"{slow},run:none", reference="run:other").json()["detail"]


def test_a_queued_run_and_a_damaged_recording_are_refused(service: Service, slow: str, fast: str) -> None:
    queued: str = service.post("/runs", {"plan": driven(service, 1.0, pace={"kind": "real_time"}, name="Waits")})["runs"][0][
        "id"
    ]
    answer = refused(service, f"{slow},run:{queued}")
    service.http.post(f"/api/v1/runs/{queued}/cancel", json={})
    assert answer.status_code == 409 and "(Waits) has no recording: it is " in answer.json()["detail"]
    damaged = done(service, driven(service, 1.0, name="Damaged"))
    (service.data / "recordings" / f"{damaged.removeprefix('run:')}.h5").write_bytes(b"not HDF5")
    answer = refused(service, f"{damaged},{fast}")
    assert answer.status_code == 409 and "(Damaged) is damaged" in answer.json()["detail"]


def test_the_previous_run_is_of_the_same_name_or_template(service: Service, slow: str) -> None:
    again = done(service, driven(service, 1.0, name="Slow"))
    found = service.get(f"/compare/previous/{again.removeprefix('run:')}")
    assert found["previous"]["ref"] == slow
    assert found["address"] == f"/compare?items={slow},{again}"
    alone = done(service, driven(service, 1.0, name="Only of this name"))
    assert service.get(f"/compare/previous/{alone.removeprefix('run:')}") == {"previous": None, "address": None}
    offered = [one["ref"] for one in service.get("/compare/candidates?q=Slow")["candidates"]]
    assert offered[:2] == [again, slow]


def test_a_comparison_has_a_report(service: Service, hybrids: list[str]) -> None:
    params = {"items": ",".join(hybrids), "reference": hybrids[1]}
    text = service.http.get(f"{URL}/report.html", params=params).text
    assert "Safety limits" in text and "<svg" in text and len(text.encode()) < 1e6
    assert service.http.get(f"{URL}/report.pdf", params=params).content.startswith(b"%PDF-")
