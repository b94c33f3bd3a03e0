"""Fragility and sensitivity of a sweep by REST."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, plan
from tests.app.test_sweeps_api import DAMPING, SWEEPS, execute, get, submit


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory, migrated: Any) -> Iterator[tuple[TestClient, str]]:
    """A sweep of six points with results: three scales, of which the largest trips, times two damping ratios."""
    settings = Settings(data=tmp_path_factory.mktemp("swept"), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE) as client:
        scales = {"kind": "factor", "values": [0.1, 0.2, 90]}
        fields = [{"path": DAMPING, "values": [1, 5], "unit": "%"}]
        sweep = submit(client, plan=plan(duration=1.5), fields=fields, scales=scales)
        execute(client, settings)
        yield client, sweep


def test_a_trip_exceeds_every_level_unless_it_is_not_to_count(swept: tuple[TestClient, str]) -> None:
    client, sweep = swept
    query = f"{sweep}/fragility?measure=floors_peak_mm.2&intensity=pga_g"
    statuses = get(client, f"{sweep}/results")["values"]["status"]
    assert statuses.count("tripped") == 2
    found = get(client, f"{query}&level=1e6")
    assert (found["points"], found["exceeding"], found["tripped"], found["left_out"]) == (6, 2, 2, 0)
    assert [one["exceeding"] for one in found["empirical"]] == [0, 0, 2]
    assert found["median"] is None and "dispersion is too small" in found["reason"]
    assert get(client, f"{query}&level=1e6&tripped=false")["exceeding"] == 0


def test_the_input_with_the_largest_effect_has_the_longest_bar(swept: tuple[TestClient, str]) -> None:
    client, sweep = swept
    found = get(client, f"{sweep}/sensitivity?measure=floors_peak_mm.2")
    assert (found["points"], found["left_out"]) == (4, 2)
    scale, damping = found["bars"]
    assert (scale["input"], scale["low_input"], scale["high_input"]) == ("motion.scale", 0.1, 0.2)
    assert scale["high"] == pytest.approx(2 * scale["low"], rel=0.05) and scale["correlation"] > 0.8
    assert (damping["input"], damping["unit"], damping["low_input"]) == (DAMPING, "%", pytest.approx(1))


@pytest.mark.parametrize(
    ("path", "status", "words"),
    [
        ("fragility?measure=none&level=1&intensity=pga_g", 422, "is not a column of numbers with the role measure"),
        ("fragility?measure=mte_mm.1&level=1&intensity=mte_mm.2", 422, "with the role intensity or input"),
        ("fragility?measure=mte_mm.1&level=nan&intensity=pga_g", 422, "finite"),
        ("sensitivity?measure=status", 422, "choose one of"),
        ("sensitivity", 422, "field required"),
    ],
)
def test_what_cannot_be_analysed_is_refused(swept: tuple[TestClient, str], path: str, status: int, words: str) -> None:
    client, sweep = swept
    answer = client.get(f"{SWEEPS}/{sweep}/{path}")
    assert answer.status_code == status and words in answer.json()["detail"]
    assert client.get(f"{SWEEPS}/none/{path}").status_code in (404, 422)
