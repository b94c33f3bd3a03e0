"""The example plans are sound, and diagnoses by them name what they leave out of the measured sets ($RTHS_RECORDINGS)."""

from __future__ import annotations

from typing import Any

import pytest

from rths_engine.diagnosis import diagnose
from rths_engine.measured import Measured, imported, read
from rths_engine.plan import Plan
from tests.conftest import RECORDINGS
from tests.test_example_mappings import EXAMPLES, example

SETS = sorted(path.parent.name for path in EXAMPLES.glob("*/plan.yaml"))


def plan(name: str) -> Plan:
    return Plan.from_yaml((EXAMPLES / name / "plan.yaml").read_text(encoding="utf-8"))


def measured(folder: str, file: str, **cut: Any) -> Measured:
    path = RECORDINGS / folder / file
    if not path.is_file():
        pytest.skip(f"no recording {path}: set RTHS_RECORDINGS to the folder that holds the sets")
    mapping = example(folder).model_copy(update=cut)
    return imported(read(path.read_bytes(), path.name), mapping, path.name)


@pytest.mark.parametrize("name", SETS)
def test_an_example_plan_is_sound_and_of_the_test_that_its_mapping_says(name: str) -> None:
    assert plan(name).test == example(name).test


def test_the_carriage_rubs_on_its_guides() -> None:
    """Fitted on the first two thirds, shown on the last."""
    fitted, kept = measured("emps", "DATA_EMPS.mat", stop=16.56), measured("emps", "DATA_EMPS.mat", start=16.56)
    found = diagnose(plan("emps"), fitted, [kept]).verdict
    assert found["effects"][0]["id"] == "coulomb_friction"
    friction = found["effects"][0]["parameters"][0]["value"]
    assert friction == pytest.approx(
        20.7, rel=0.1
    )  # Janot, Gautier and Brunot (2019), with inertia and offset fitted beside it
    assert found["fit"]["baseline"]["heldout_nrmse"] > 0.15
    assert found["fit"]["extended"]["heldout_nrmse"] < 0.045


def test_an_mr_damper_yields() -> None:
    found = diagnose(plan("mr_damper"), measured("mr_damper", "ensaio1.1.csv")).verdict
    assert {"coulomb_friction", "stribeck_friction", "bouc_wen_hysteresis"} & {one["id"] for one in found["effects"]}
    assert found["fit"]["extended"]["heldout_nrmse"] < 0.5 * found["fit"]["baseline"]["heldout_nrmse"]
