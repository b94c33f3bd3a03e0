"""Material laws of OpenSees: the rig presses as a closed form says, and verdicts on concealed laws get the right outcome."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from rths_engine.parts import physics
from rths_engine.recordings import opening
from tests.opensees import peer
from tests.opensees.__main__ import diagnosed, table
from tests.opensees.concealed import LAWS, Case, cases
from tests.opensees.judged import REACHED, judged
from tests.opensees.laws import SPECIMENS
from tests.proof.test_protocol import diagnosis, effect

BILINEAR = "specimen:1/bouc_wen_hysteresis"


@pytest.fixture
def _with_opensees() -> None:
    if reason := peer.missing():
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(reason)


@pytest.mark.usefixtures("_with_opensees")
def test_the_rig_of_opensees_presses_springs_and_dashpots_as_closed_forms_say() -> None:
    t = np.arange(0.0, 2.0, 1e-3)
    x, v = 0.02 * (1 - np.cos(3 * t)), 0.06 * np.sin(3 * t)
    request = {"task": "pressed", "displacement": x.tolist(), "velocity": v.tolist(), "dt": 1e-3}
    spring = peer.answered({**request, "materials": [["Elastic", 2e6], ["Viscous", 1e5, 1.0]]})["force"]
    assert np.array(spring) == pytest.approx(2e6 * x + 1e5 * v, rel=1e-9, abs=1e-6)
    damper = np.array(peer.answered({**request, "materials": [["ViscousDamper", 1e9, 1e5, 0.4]]})["force"])
    fast = np.abs(v) > 0.02  # where the stiff spring in series takes no part
    assert damper[fast] == pytest.approx(1e5 * np.sign(v[fast]) * np.abs(v[fast]) ** 0.4, rel=0.01)


@pytest.mark.usefixtures("_with_opensees")
def test_a_specimen_that_conceals_stiffening_is_written_diagnosed_and_named(tmp_path: Path) -> None:
    case = Case("specimen", "stiffening", "low", seed=0, duration=8.0)
    case.write(tmp_path / case.name)
    fitted, *others = (opening.load(tmp_path / case.name / f"{one}.h5") for one in ("fit", "heldout1", "heldout2"))
    assert all(len(one.time) == len(fitted.time) for one in others)
    row = diagnosed(case, tmp_path / case.name)
    assert row["outcome"] in REACHED
    assert case.truth.title in table([row])


def test_every_law_is_tested_at_each_noise_and_one_law_of_each_kind_is_a_control() -> None:
    assert len({one.name for one in cases(0)}) == 2 * sum(len(laws) for laws in LAWS.values())
    assert [one.name for one in cases(0, "specimen-gap")] == ["specimen-gap-low", "specimen-gap-high"]
    for laws in LAWS.values():
        assert [name for name, law in laws.items() if law.control] == ["linear"]


@pytest.mark.parametrize("kind", LAWS)
def test_right_and_near_names_are_effects_of_the_library(kind: str) -> None:
    names = {effect.model_fields["kind"].default for effect in (*physics.SPECIMEN, *physics.STRUCTURE)}
    for law in LAWS[kind].values():
        assert law.right | law.near <= names and not law.right & law.near


@pytest.mark.parametrize(
    ("law", "verdict", "said", "outcome"),
    [
        ("bilinear", "mismatch", [effect(BILINEAR)], "named"),
        ("bilinear", "mismatch", [effect("specimen:1/coulomb_friction")], "near"),
        ("bilinear", "mismatch", [effect(BILINEAR), effect("sensor:f_meas.1/offset")], "wrong"),
        ("bilinear", "mismatch", [effect("sensor:f_meas.1/offset", 0.4)], "missed"),
        ("bilinear", "mismatch", [{**effect("specimen:1/pinching", 0.4), "part_of_it": True}], "part of it"),
        ("bilinear", "mismatch", [{**effect("specimen:1/pinching", 0.6), "part_of_it": True}], "wrong"),
        ("bilinear", "mismatch", [effect("specimen:1/unknown")], "unknown"),
        ("bilinear", "undetermined", [], "unknown"),
        ("bilinear", "recalibrate", [], "missed"),
        ("linear", "recalibrate", [], "agrees"),
        ("linear", "undetermined", [], "false alarm"),
        ("linear", "mismatch", [effect("specimen:1/coulomb_friction")], "wrong"),
    ],
)
def test_outcome_of_a_verdict(law: str, verdict: str, said: list[dict[str, object]], outcome: str) -> None:
    assert judged("specimen", SPECIMENS[law], diagnosis(verdict, *said))["outcome"] == outcome


def test_no_verdict_is_an_outcome() -> None:
    assert judged("specimen", SPECIMENS["gap"], None)["outcome"] == "no verdict"
