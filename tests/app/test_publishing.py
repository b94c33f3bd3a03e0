"""MATLAB files and data sets for DesignSafe: names, required entities and metadata, folders; by REST and command line."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from scipy.io import loadmat

from app.cli.main import main
from app.config import Settings
from app.publishing.designsafe.entities import KINDS, SIMULATION
from app.publishing.matlab import KEYWORDS, LONGEST, name, write
from rths_engine.planning import templates
from rths_engine.recordings.run_file import Recording, load
from tests.app.test_reports import recorded, shortened
from tests.app.test_runs_api import execute, submit

GIVEN: dict[str, Any] = {
    "project": {
        "title": "Damped frame",
        "description": "d" * 1000,
        "pi": "aruiz",
        "keywords": ["MR damper"],
        "projectId": "PRJ-12",
    },
    "hybridSimulation": {
        "title": "Frame with MR dampers",
        "description": "s" * 750,
        "keywords": ["hybrid"],
        "authors": [{"fname": "Ana", "lname": "Ruiz", "inst": "Structures Laboratory"}],
        "facility": "uc-berkeley",
    },
    "license": "Creative Commons Attribution",
    "categories": {"exp_substructure": {"title": "Damper", "description": "c" * 60}},
}


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("published")
    recorded(folder, shortened("two-storeys", duration=2.0))
    return folder / "run.h5"


@pytest.fixture(scope="module")
def recording(file: Path) -> Recording:
    return load(file)


@pytest.mark.parametrize("key", ["x_cmd.1", "1st", "_a", "end", "v" * 70, "Δα.2", "force_ext.12"])
def test_every_name_in_a_matlab_file_is_one_that_matlab_takes(key: str) -> None:
    made = name(key)
    assert made.isidentifier() and made.isascii() and made[0].isalpha() and len(made) <= LONGEST and made not in KEYWORDS


def test_a_matlab_file_has_every_channel_with_unit_and_the_measures(recording: Recording, tmp_path: Path) -> None:
    write(tmp_path / "run.mat", {"name": "Run"}, recording)
    found = loadmat(tmp_path / "run.mat", simplify_cells=True)
    np.testing.assert_allclose(found["t"], recording.time)
    for channel in recording.channels:
        one = found[name(channel.key)]
        np.testing.assert_array_equal(one["values"], recording.signal(channel.key))
        assert one["unit"] == channel.unit and one["label"] == channel.label
    assert found["x_meas_2"]["station"] == 2 and found["test"]["digest"] == recording.plan.digest
    mte = found["measures"]["station_1"]["mte_mm"]
    assert mte["value"] == pytest.approx(recording.summary["stations"][0]["mte_mm"]) and mte["unit"] == "mm"
    raw = loadmat(tmp_path / "run.mat")
    assert raw["t"].shape == (len(recording.time), 1)


def test_the_data_set_is_laid_out_as_designsafe_publishes_it(file: Path, tmp_path: Path, recording: Recording) -> None:
    (tmp_path / "meta.yaml").write_text(json.dumps(GIVEN))
    out = tmp_path / "set.zip"
    assert main(["report", str(file), "--designsafe", "--metadata", str(tmp_path / "meta.yaml"), "--out", str(out)]) == 0
    with zipfile.ZipFile(out) as archive:
        names = archive.namelist()
        data = json.loads(archive.read("PRJ-12/metadata.json"))
        head = archive.read(next(one for one in names if one.endswith("/experimental_output_1.csv"))).split(b"\r\n")
        assert archive.testzip() is None
    assert head[0] == b"t (s),x_meas.1 (mm),f_meas.1 (kN)" and len(head) == len(recording.time) + 2
    top = "PRJ-12/Hybrid-simulation--frame-with-mr-dampers/data"
    chain = "Global-model--structure-loading-and-rig/Coordinator--integration-and-compensation"
    assert f"{top}/{chain}/Experimental-substructure--damper-station-2/data/station_2.json" in names
    assert f"{top}/{chain}/Simulation-substructure--computed-structure/data/mass_kg.csv" in names
    assert f"{top}/Report--test-report-and-data-dictionary/data/report.pdf" in names
    entities = data["entities"]
    made = {one["name"] for one in entities}
    assert made == {SIMULATION, *(kind.name for kind in KINDS.values())}
    files = [one["value"]["fileObjs"] for one in entities if one["name"] != SIMULATION]
    assert all(files) and all(f"PRJ-12{one['path']}" in names for given in files for one in given)
    above = {one["target"]: one["source"] for one in data["tree"]["links"]}
    kinds = {one["id"]: one["name"].rpartition(".")[2] for one in data["tree"]["nodes"]}
    pairs = {(kinds[source], kinds[target]) for target, source in above.items()}
    assert ("coordinator", "exp_substructure") in pairs and ("exp_substructure", "exp_output") in pairs
    assert ("project", "hybrid_simulation") in pairs and ("global_model", "coordinator") in pairs
    simulation = next(one["value"] for one in entities if one["name"] == SIMULATION)
    assert simulation["simulationType"]["name"] == "Earthquake" and simulation["facility"]["id"] == "uc-berkeley"
    assert data["baseProject"]["value"]["nhTypes"] == [{"id": "earthquake", "name": "Earthquake"}]


def test_a_data_set_is_refused_with_everything_that_is_missing(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "set.zip"
    assert main(["report", str(file), "--designsafe", "--out", str(out)]) == 2
    said = capsys.readouterr().err
    for where in ("project.title", "project.description", "project.pi", "hybridSimulation.authors", "license"):
        assert where in said, where
    assert "1000 to 5000 characters" in said and not out.exists()
    wrong = {"project": {"nhTypes": ["Meteorite"]}, "categories": {"exp_output": {"description": "short"}, "camera": {}}}
    (tmp_path / "meta.yaml").write_text(json.dumps(wrong))
    assert main(["report", str(file), "--designsafe", "--metadata", str(tmp_path / "meta.yaml"), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert "Meteorite" in said and "has 5 characters" in said and "categories.camera" in said
    (tmp_path / "meta.yaml").write_text("project: {colour: red}")
    assert main(["report", str(file), "--designsafe", "--metadata", str(tmp_path / "meta.yaml")]) == 2
    assert "project.colour" in capsys.readouterr().err


def test_a_test_without_structure_lacks_an_entity(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorded(tmp_path, templates.template("specimen-mr-damper").model_copy(update={"duration": 0.5}))
    assert main(["report", str(tmp_path / "run.h5"), "--designsafe", "--out", str(tmp_path / "a.zip")]) == 2
    assert "sim_substructure is missing" in capsys.readouterr().err.replace("sim_substructure: is", "sim_substructure is")


def test_a_recording_file_has_reports_without_a_server(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for option, ending, begins in (
        (["--html"], ".html", b"<!doctype"),
        (["--pdf"], ".pdf", b"%PDF-"),
        (["--mat"], ".mat", b"MATLAB 5.0"),
    ):
        out = tmp_path / f"report{ending}"
        assert main(["report", str(file), *option, "--out", str(out), "--data", str(tmp_path)]) == 0
        assert out.read_bytes().lower().startswith(begins.lower())
    assert main(["report", str(file), "--pdf", "--out", str(tmp_path / "a.html")]) == 2
    assert main(["report", str(file), "--out", str(tmp_path / "a.doc")]) == 2
    assert main(["report", "no-such-run", "--data", str(tmp_path)]) == 2
    assert main(["report", str(file), "--metadata", "x.yaml", "--out", str(tmp_path / "a.html")]) == 2
    assert "there is no database" in capsys.readouterr().err


def test_rest_and_command_line_publish_a_run_of_the_database(client: TestClient, settings: Settings, tmp_path: Path) -> None:
    run = submit(client)
    execute(client, settings, run)
    address = f"/api/v1/runs/{run}"
    said = {"from_s": 0.1, "text": "试验 😀", "by": "试"}  # no font of a PDF has them
    assert client.post(f"{address}/annotations", json=said).status_code == 201
    assert client.patch(address, json={"name": "试验 😀", "notes": "试", "tags": ["试"]}).status_code == 200
    assert client.get(f"{address}/report.pdf").content.startswith(b"%PDF-")
    asked = client.post(f"{address}/designsafe/check", json={}).json()["missing"]
    assert {"where": "license", "problem": "is missing"}.items() <= next(
        one for one in asked if one["where"] == "license"
    ).items()
    refused = client.post(f"{address}/designsafe.zip", json={})
    assert refused.status_code == 422 and len(refused.json()["errors"]) == len(asked)
    assert client.post(f"{address}/designsafe/check", json=GIVEN).json() == {"missing": []}
    made = client.post(f"{address}/designsafe.zip", json=GIVEN)
    assert zipfile.ZipFile(io.BytesIO(made.content)).namelist()[0] == "PRJ-12/README.txt"
    matlab = client.get(f"{address}/recording.mat")
    assert loadmat(io.BytesIO(matlab.content))["t"].shape[1] == 1
    out = tmp_path / "run.html"
    assert main(["report", run, "--out", str(out), "--data", str(settings.data)]) == 0 and "<svg" in out.read_text()
