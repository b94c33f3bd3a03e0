"""The league of compensators by REST and on its page: shipped results, results of the data folder, and none."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from app.cli.main import main
from app.config import Settings
from app.league.service import SHIPPED, shipped
from app.main import create_app
from rths_engine.parts import compensators
from tests.app.conftest import ADDRESS, HERE


def client(folder: Path) -> TestClient:
    settings = Settings(data=folder, embedded_worker=False, local_sign_in=True)
    return TestClient(create_app(settings), ADDRESS, client=HERE)


def test_the_shipped_league_is_shown_until_the_data_folder_has_its_own(tmp_path: Path) -> None:
    with client(tmp_path) as http:
        shipped = http.get("/api/v1/league").json()
        assert shipped["shipped"] and shipped["cases"] == [1]
        assert [one["symbol"] for one in shipped["criteria"]] == [f"J{number}" for number in range(1, 10)]
        page = http.get("/league")
        assert page.status_code == 200 and "Came with the program" in page.text
        assert "Adaptive time series (ATS)" in page.text and "published design" in page.text
        own = json.loads((SHIPPED / "case-1.json").read_text(encoding="utf-8"))
        (tmp_path / "league").mkdir()
        (tmp_path / "league" / "case-1.json").write_text(json.dumps(own | {"plants": 3}), encoding="utf-8")
        found = http.get("/api/v1/league").json()
        assert not found["shipped"] and found["league"]["plants"] == 3
        assert "Measured here" in http.get("/league").text


def test_a_case_without_a_league_says_how_to_measure_it_and_a_damaged_file_is_named(tmp_path: Path) -> None:
    with client(tmp_path) as http:
        missing = http.get("/api/v1/league?case=2")
        assert missing.status_code == 404 and "rths league --case 2" in missing.json()["detail"]
        assert http.get("/api/v1/league?case=9").status_code == 422
        (tmp_path / "league").mkdir()
        (tmp_path / "league" / "case-2.json").write_text("{", encoding="utf-8")
        damaged = http.get("/api/v1/league?case=2")
        assert 400 <= damaged.status_code < 500 and damaged.json()["errors"][0]["where"] == "league/case-2.json"


def test_figures_of_another_program_stand_beside_ours_without_noise(tmp_path: Path) -> None:
    with client(tmp_path) as http:
        found = http.get("/api/v1/league").json()["other_program"]
        given = {(one["kind"], one["published"]): (one["j1_ms"], one["j2_percent"]) for one in found["figures"]}
        assert given == {
            ("none", False): (12, 56),
            ("pi_phase_lead", True): (4.64, 10.1),
            ("inverse", False): (1.71, 5.98),
            ("aic", False): (1.95, 6.88),
            ("ats", False): (0, 0.22),
        }
        assert "independent trial" in found["source"] and not found["sensor_noise"]
        page = http.get("/league").text
        assert "J2 of another program, %" in page and "only 49 samples" in page and "J3: tracking error, largest" in page


def test_the_page_of_a_case_without_a_league_names_the_command(tmp_path: Path) -> None:
    with client(tmp_path) as http:
        page = http.get("/league?case=3")
        assert page.status_code == 404 and "rths league --case 3" in page.text and 'href="/league?case=1"' in page.text
        assert "404" in http.get("/openapi.json").json()["paths"]["/api/v1/league"]["get"]["responses"]


@pytest.mark.parametrize(
    ("path", "entry"), [("/league", "Table IV"), ("/help/docs/league.md", "Help"), ("/stability?x=1", "Stability")]
)
def test_the_menu_marks_the_entry_to_which_a_page_belongs(tmp_path: Path, path: str, entry: str) -> None:
    with client(tmp_path) as http:
        marked = re.findall(r'<a href="[^"]*" aria-current="(?:page|true)">([^<]*)', http.get(path).text)
        assert marked == [entry]


def test_some_compensators_join_the_league_on_the_page_and_never_hide_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = shipped(1)
    assert whole
    again = next(row for row in whole.rows if row.kind == "inverse")
    measured = whole.model_copy(update={"made": "2027-01-02T00:00:00+00:00", "rows": [again]})
    monkeypatch.setattr("app.cli.league.run_league", lambda *_: measured)
    for refused in (["--plants", "0"], ["--only", "inverse", "--plants", "0"], ["--only", "ats", "--case", "3"]):
        assert main(["league", *refused, "--data", str(tmp_path)]) == 2
        assert "--out" in capsys.readouterr().err
    assert not (tmp_path / "league").exists()
    assert main(["league", "--only", "inverse", "--data", str(tmp_path)]) == 0
    assert "beside the rows measured earlier" in capsys.readouterr().out
    with client(tmp_path) as http:
        rows = http.get("/api/v1/league").json()["league"]["rows"]
        assert [row["kind"] for row in rows] == [row.kind for row in whole.rows]
        assert [row["kind"] for row in rows if row["made"]] == ["inverse"]
        assert "measured again 2027-01-02" in http.get("/league").text
    out = tmp_path / "mine.json"
    assert main(["league", "--only", "inverse", "--plants", "0", "--out", str(out), "--data", str(tmp_path)]) == 0
    assert len(json.loads(out.read_text(encoding="utf-8"))["rows"]) == 1


def test_the_rows_of_the_shipped_league_are_compensators_of_the_registry() -> None:
    rows = json.loads((SHIPPED / "case-1.json").read_text(encoding="utf-8"))["rows"]
    assert {row["kind"] for row in rows} <= {kind.model_fields["kind"].default for kind in compensators.KINDS}
