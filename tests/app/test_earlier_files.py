"""A data folder written by version 0.1.0 opens today: pages, routes and downloads of its rows, and the jobs in its queue."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from fastapi.testclient import TestClient

from rths_engine.planning.reading import plan_from_yaml
from rths_engine.recordings.opening import load
from tests.app.conftest import unpack_earlier
from tests.browser.service import Service, running, until

PATIENCE_S = 240  # two busy cores
WITH_RECORDING = ("Completed", "Tripped", "Cancelled", "Damper with play")


def rows(client: TestClient, kind: str) -> dict[str, dict[str, Any]]:
    """The rows of a list by name; of two with the same name the newer."""
    return {row["name"]: row for row in reversed(client.get(f"/api/v1/{kind}").json()[kind])}


def opened(client: TestClient, path: str) -> Any:
    answer = client.get(path)
    assert answer.status_code == 200, f"{path}: {answer.status_code} {answer.text[:500]}"
    return answer


def test_every_row_is_listed_as_it_was_stored(earlier: TestClient) -> None:
    runs = rows(earlier, "runs")
    assert {name: run["state"] for name, run in runs.items()} == {
        "Completed": "completed",
        "Tripped": "tripped",
        "Cancelled": "cancelled",
        "Damper with play": "completed",
        "Damper with play, before diagnosis": "completed",
        "Damper with play, after diagnosis": "completed",
        "Queued": "queued",
    }
    first = runs["Completed"]
    assert first["code_version"] == "0.1.0" and first["submitted_by"] == "Ana Ruiz"
    assert [station["peak_stroke_mm"] for station in first["stations"]] == pytest.approx([0.05414, 0.04730], rel=1e-3)
    assert runs["Tripped"]["trip"]["station"] == 1
    assert list(rows(earlier, "recordings")) == ["Sine test"]
    diagnoses = rows(earlier, "diagnoses")
    assert {name: one["state"] for name, one in diagnoses.items()} == {"Worn damper": "completed", "Queued": "queued"}
    assert diagnoses["Worn damper"]["found"] == "mismatch"


def test_every_page_of_every_row_opens(earlier: TestClient) -> None:
    pages = ["/", "/lab", "/new", "/runs", "/recordings", "/diagnoses", "/table4"]
    for kind in ("runs", "recordings", "diagnoses"):
        pages += [f"/{kind}/{row['id']}" for row in rows(earlier, kind).values()]
    pages += [f"/stability/{run['id']}" for run in rows(earlier, "runs").values()]
    for path in pages:
        assert "<html" in opened(earlier, path).text or path == "/lab", path
    shown = rows(earlier, "diagnoses")["Worn damper"]
    assert "backlash" in opened(earlier, f"/diagnoses/{shown['id']}").text


def test_every_route_of_every_row_answers(earlier: TestClient) -> None:
    """409 is right only of what has no recording, or no verdict, yet."""
    ids = {
        "run_id": [(row["id"], row["state"] != "queued") for row in rows(earlier, "runs").values()],
        "recording_id": [(row["id"], True) for row in rows(earlier, "recordings").values()],
        "sha256": [(row["raw_sha256"], True) for row in rows(earlier, "recordings").values()],
        "diagnosis_id": [(row["id"], row["state"] != "queued") for row in rows(earlier, "diagnoses").values()],
    }
    asked = 0
    for path, item in earlier.app.openapi()["paths"].items():  # type: ignore[attr-defined]
        name = path.partition("{")[2].partition("}")[0]
        for identifier, ended in ids.get(name, []) if "get" in item else []:
            answer = earlier.get(path.replace(f"{{{name}}}", identifier))
            waiting = not ended and path.rsplit(".", 1)[-1] in ("h5", "csv", "html", "json", "pdf", "mat")
            assert answer.status_code == (409 if waiting else 200), f"{answer.url}: {answer.status_code} {answer.text[:500]}"
            asked += 1
    assert asked > 40


@pytest.mark.parametrize("name", WITH_RECORDING)
def test_a_recording_comes_as_hdf5_and_as_csv_with_the_same_numbers(earlier: TestClient, name: str) -> None:
    run = rows(earlier, "runs")[name]
    raw = opened(earlier, f"/api/v1/runs/{run['id']}/recording.h5").content
    assert len(raw) == run["recording"]["size"]
    text = opened(earlier, f"/api/v1/runs/{run['id']}/recording.csv").text
    table = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1, ndmin=2)
    with h5py.File(io.BytesIO(raw), "r") as file:
        assert table.shape == (file["signals"].shape[0], file["signals"].shape[1] + 1)
    assert table[0, 0] > 0 and np.isfinite(table).all()
    assert len(text.splitlines()[0].split(",")) == table.shape[1]


@pytest.mark.parametrize("name", WITH_RECORDING)
def test_a_report_of_an_old_run_is_written_today(earlier: TestClient, name: str) -> None:
    run = rows(earlier, "runs")[name]
    assert name in opened(earlier, f"/api/v1/runs/{run['id']}/report.html").text
    assert plan_from_yaml(opened(earlier, f"/api/v1/runs/{run['id']}/plan.yaml").text).digest == run["digest"]


def test_an_old_recording_is_read_by_its_roles(earlier: TestClient, tmp_path: Path) -> None:
    run = rows(earlier, "runs")["Completed"]
    path = tmp_path / "old.h5"
    path.write_bytes(opened(earlier, f"/api/v1/runs/{run['id']}/recording.h5").content)
    measured = load(path)
    assert list(measured.numbers("station")) == [1, 2]
    for station in (1, 2):
        stroke = 1e3 * np.max(np.abs(measured.get("x_meas", station)))
        assert stroke == pytest.approx(run["stations"][station - 1]["peak_stroke_mm"], rel=1e-9)


def test_what_waited_in_the_old_queue_is_done_and_an_old_recording_is_diagnosed_by_its_old_plan(tmp_path: Path) -> None:
    unpack_earlier(tmp_path)
    with running(tmp_path) as service:
        runs = {run["name"]: run for run in service.get("/runs")["runs"]}
        done = service.wait(runs["Queued"]["id"], "completed", within_s=PATIENCE_S)
        assert done["digest"] == runs["Completed"]["digest"]
        assert signals(service, done["id"]) == pytest.approx(signals(service, runs["Completed"]["id"]), rel=1e-9, abs=1e-12)
        stored = {one["name"]: one for one in service.get("/diagnoses")["diagnoses"]}
        played, plan = runs["Damper with play"]["id"], service.get(f"/diagnoses/{stored['Worn damper']['id']}")["plan"]
        asked = service.post("/diagnoses", {"recording": {"run": played}, "plan": plan, "name": "Again"})
        for one in (stored["Queued"], asked):
            found = diagnosed(service, one["id"])
            assert [effect["id"] for effect in found["verdict"]["effects"]] == ["backlash"]


def diagnosed(service: Service, diagnosis_id: str) -> dict[str, Any]:
    """The diagnosis once it has ended."""
    ended = lambda one: one["state"] in ("completed", "failed", "cancelled")  # noqa: E731
    found: dict[str, Any] = until(lambda: service.get(f"/diagnoses/{diagnosis_id}"), ended, PATIENCE_S)
    assert found["state"] == "completed", found["reason"]
    return found


def signals(service: Service, run_id: str) -> np.ndarray:
    with h5py.File(service.data / "recordings" / f"{run_id}.h5", "r") as file:
        return np.asarray(file["signals"])
