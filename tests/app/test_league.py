"""The league of compensators by REST and on its page: shipped results, results of the data folder, and none."""

from __future__ import annotations

import json
from pathlib import Path

from fastapi.testclient import TestClient

from app.config import Settings
from app.league.service import SHIPPED
from app.main import create_app
from rths_engine.parts import compensators


def client(folder: Path) -> TestClient:
    return TestClient(create_app(Settings(data=folder, embedded_worker=False)))


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


def test_the_rows_of_the_shipped_league_are_compensators_of_the_registry() -> None:
    rows = json.loads((SHIPPED / "case-1.json").read_text(encoding="utf-8"))["rows"]
    assert {row["kind"] for row in rows} <= {kind.model_fields["kind"].default for kind in compensators.KINDS}
