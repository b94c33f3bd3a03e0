"""The Python client against a running service; its notebook runs."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rths.client import Client, ClientError, NotCompleted, Refused, TooLong, Unreachable
from tests.browser.service import Service

NOTEBOOK = Path(__file__).parents[2] / "docs" / "client.ipynb"


@pytest.fixture
def lab(idle: Service) -> Iterator[Client]:
    with Client(idle.url, by="Ana Ruiz") as one:
        yield one


def test_the_notebook_runs(idle: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RTHS_URL", idle.url)
    names: dict[str, Any] = {}
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), str(NOTEBOOK), "exec"), names)
    run, recording, results = names["run"], names["recording"], names["results"]
    assert run.data["submitted_by"] == "Ana Ruiz"
    assert recording.summary["stations"] == [
        {key: one[key] for key in recording.summary["stations"][0]} for one in run.stations
    ]
    assert names["error"] * 1e3 == pytest.approx(run.stations[0]["mte_mm"], rel=1e-9)
    assert list(names["frame"].index[:1]) == [recording.time[0]] and len(names["frame"]) == len(recording.time)
    assert np.argmin(results["rms_percent.1"]) == 1  # the delay of the first station is 30 steps
    assert "friction" in names["diagnosis"].sentence.lower()


def test_a_refused_plan_says_each_field(lab: Client) -> None:
    with pytest.raises(Refused, match=r"controller_rate.*duration|duration.*controller_rate") as refused:
        lab.submit(lab.plan("two-storeys") | {"controller_rate": -1, "duration": -2})
    assert refused.value.status == 422 and {one.where for one in refused.value.problems} == {"controller_rate", "duration"}
    with pytest.raises(Refused, match="There is no template 'nothing'"):
        lab.plan("nothing")


def test_waiting_is_bounded_and_a_cancelled_test_has_not_completed(lab: Client) -> None:
    run = lab.submit(lab.plan("two-storeys") | {"pace": {"kind": "real_time"}})
    with pytest.raises(TooLong, match="the job goes on"):
        lab.wait(run, progress=False, within_s=0.0)
    lab.cancel(run)
    with pytest.raises(NotCompleted, match="cancelled: "):
        lab.wait(run, progress=False, completed=True)
    assert run.id in {one.id for one in lab.runs(state="cancelled")}


def test_a_laboratory_that_is_not_there_is_named() -> None:
    with Client("http://127.0.0.1:9") as lab, pytest.raises(Unreachable, match=r"127.0.0.1:9.*rths serve"):
        lab.templates()


@pytest.mark.parametrize("plan", [None, 3, {"duration": float("nan")}, {"duration": object()}, "nowhere.yaml"])
def test_what_is_no_plan_is_refused_with_a_sentence_before_it_is_sent(plan: Any) -> None:
    with Client("http://127.0.0.1:9") as lab:
        for use in (lab.check, lab.submit):
            with pytest.raises(ClientError, match=r"a plan is a mapping|cannot be sent as JSON|cannot be read") as refused:
                use(plan)
            assert not isinstance(refused.value, Unreachable)
