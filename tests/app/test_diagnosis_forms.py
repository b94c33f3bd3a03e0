"""The verdict in the API: typed, its schema published, and verdicts stored by version 0.1.0 as they were stored."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy import select, update

from app import db
from app.calculations.answer import Calculator
from app.diagnoses.service import DiagnosisService
from app.models import Diagnosis
from app.reports.diagnosis_tables import tables
from app.reports.digits import NONE
from rths_engine.diagnosis.schema import Pictures, Verdict
from tests.app.test_diagnoses_refusals import PICTURES, URL, queued, recording

__all__ = ["recording"]
# stored by version 0.1.0: computed parts with noise 0 and p 1 or 1e-300, and probabilities that nothing was computed for
EARLIER: dict[str, Any] = {
    "schema": "rths-diagnosis/1",
    "verdict": "configuration_error",
    "components": [
        {"component": "compensator:1", "residual_nrmse": 0.02, "noise_nrmse": 0.0, "p_value": 1e-300, "mismatch": True,
         "verdict": "configuration_error"},
        {"component": "structure", "residual_nrmse": 9.3e-16, "noise_nrmse": 0.0, "p_value": 1.0, "mismatch": False,
         "verdict": "consistent"},
        {"component": "actuator:1", "residual_nrmse": 0.0037, "noise_nrmse": 0.00047, "p_value": 3e-300, "mismatch": True,
         "verdict": "mismatch"},
    ],
    "where": {"component": "actuator:1", "times_s": [[8.0, 9.0]], "bands_hz": [[0.4, 45.2]], "state": "grows with command"},
    "effects": [
        {"component": "compensator:1", "id": "configuration_error", "probability": 1.0, "sentence": "Other settings.",
         "parameters": []},
        {"component": "actuator:1", "id": "gain_error", "probability": 0.75, "sentence": "It moves less.", "parameters": [
            {"name": "share", "value": -0.000478, "unit": "1", "label": "Gain error e", "shown": "%", "factor": 0.01,
             "ci90": [-0.00053, -0.00042]}]},
        {"component": "actuator:1", "id": "unknown", "probability": 0.995, "sentence": "Something else.", "parameters": []},
    ],
    "candidates": [
        {"effects": ["actuator:1/gain_error"], "probability": 0.75, "delta_bic": 0.0, "heldout_nrmse": 0.00084},
        {"effects": [], "probability": 2.2e-64, "delta_bic": 3514.8, "heldout_nrmse": None},
    ],
    "indistinguishable": [["actuator:1/gain_error", "sensor:x_meas.1/scale_error"]],
    "fit": {"baseline": {"fit_nrmse": 0.00067, "heldout_nrmse": 0.00097},
            "extended": {"fit_nrmse": 0.00047, "heldout_nrmse": 0.00084}, "noise_floor_nrmse": 0.00047},
    "unexplained": {"fraction": 0.0, "formula": None, "words": "Noise."},
    "next_test": {"separates": ["actuator:1/gain_error", "sensor:x_meas.1/scale_error"], "signal": "a sine of 73.7 mm",
                  "expected_lambda": 12.0},
    "extended_plan": None,
}  # fmt: skip

# fields that later versions added, as they read where nothing was stored
NO_PROOF = {"part_of_it": False, "gain": None, "gain_ci90": None, "share_of_error": None, "blocks": None, "other_motion": False}
NOT_DESCRIBED: dict[str, Any] = {
    **{name: None for name in ("size", "unit", "formula_share", "state_share", "state")},
    **{name: [] for name in ("times_s", "bands_hz", "terms")},
}
NO_COMMAND = {name: None for name in ("tells", "waveform", "amplitude", "frequency", "cycles", "factor")}
SHOWN = {
    **EARLIER,
    "unexplained": {**EARLIER["unexplained"], **NOT_DESCRIBED},
    "next_test": {**EARLIER["next_test"], **NO_COMMAND},
    "effects": [{**effect, **NO_PROOF} for effect in EARLIER["effects"]],
    "remaining_share": None,
    "replicated": False,
    "rejected": [],
    "certificate": None,
}


@pytest.fixture
def stored(client: TestClient, recording: str) -> str:
    """The id of a diagnosis whose row holds EARLIER."""
    name: str = queued(client, recording)["id"]
    with db.unit_of_work(client.app.state.sessions) as session:  # type: ignore[attr-defined]
        session.execute(update(Diagnosis).where(Diagnosis.id == name).values(verdict=EARLIER, pictures=PICTURES))
    return name


def test_a_verdict_of_version_0_1_0_opens_with_the_numbers_it_was_stored_with(client: TestClient, stored: str) -> None:
    assert client.get(f"{URL}/{stored}/verdict.json").json() == SHOWN
    assert client.get(f"{URL}/{stored}").json()["verdict"] == SHOWN
    for path in (f"/diagnoses/{stored}", f"{URL}/{stored}/report.html"):
        text = client.get(path).text
        assert "Other settings." in text and "Gain error (actuator of " in text, path


def test_a_number_that_was_not_computed_is_a_dash_for_people() -> None:
    part = {**EARLIER["components"][0], "noise_nrmse": None, "p_value": None}
    told = tables(Verdict.read({**EARLIER, "components": [part, EARLIER["components"][2]]}), {})
    assert [row[3:] for row in told.components] == [[NONE, NONE], ["0.047", "< 1e-12"]]


def test_the_schemas_are_published_and_the_responses_typed_by_them(client: TestClient) -> None:
    described = client.get("/openapi.json").json()
    for path, form, response in (
        ("schema", Verdict, f"{URL}/{{diagnosis_id}}/verdict.json"),
        ("pictures-schema", Pictures, f"{URL}/{{diagnosis_id}}/pictures.json"),
    ):
        published = client.get(f"{URL}/{path}").json()
        assert published == form.json_schema()
        typed = described["paths"][response]["get"]["responses"]["200"]["content"]["application/json"]["schema"]
        assert typed == {"$ref": f"#/components/schemas/{form.__name__}"}
        assert described["components"]["schemas"][form.__name__]["properties"].keys() == published["properties"].keys()


def test_runs_with_another_excitation_are_not_plotted_and_can_be_queued_again(
    client: TestClient, stored: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    reason = "The ground motion differs by 132 % in the run A."
    monkeypatch.setattr(DiagnosisService, "differences", lambda *_: reason)
    monkeypatch.setattr(Calculator, "__call__", lambda _, bound, work, *given: work(*given))  # here, where it is replaced
    with db.unit_of_work(client.app.state.sessions) as session:  # type: ignore[attr-defined]
        extended = {**EARLIER, "extended_plan": session.scalar(select(Diagnosis.plan).where(Diagnosis.id == stored))}
        session.execute(update(Diagnosis).where(Diagnosis.id == stored).values(verdict=extended))
    text = client.get(f"/diagnoses/{stored}").text
    assert reason in text and "different excitations" in text and 'id="simulate"' in text
    answer = client.post(f"{URL}/{stored}/simulations", json={})
    assert answer.status_code == 201, answer.text
    again = client.post(URL, json={"recording": recording_of(client, stored), "extended_plan_of": stored})
    assert again.status_code == 201, again.text


def recording_of(client: TestClient, diagnosis: str) -> dict[str, str]:
    return {"recording": client.get(f"{URL}/{diagnosis}").json()["recording"]["recording_id"]}
