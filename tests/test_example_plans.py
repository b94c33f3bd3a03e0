"""The example plans are sound, and diagnoses by them name what they leave out of the measured sets ($RTHS_RECORDINGS)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis import diagnose
from rths_engine.measured import Measured, imported, read
from rths_engine.plan import Plan
from tests.conftest import RECORDINGS
from tests.test_example_mappings import EXAMPLES, example

A1_05 = "A1-05_Disp_Free_Vibration_History.txt"
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


def test_the_band_of_a_friction_damper_is_slack() -> None:
    """Fitted on two sines, shown on the displacements of an earthquake, over its strong part."""
    fitted, more = (measured("brfd", f"{rate}Hz36lbtension1amplitude.json") for rate in ("0.5", "1"))
    found = diagnose(plan("brfd"), fitted, [measured("brfd", "ImperialValleyDBE.json")], more=[more])
    numbers = {one["id"]: one["parameters"][0]["value"] for one in found.verdict["effects"]}
    assert 3e-3 < numbers["backlash"] < 5e-3
    assert -0.2 < numbers["asymmetry"] < -0.05
    judged = found.judged[0]
    shown = judged.heldout[0]
    strong = (shown.time >= 3.0) & (shown.time <= 7.5)
    real = shown.measured[0, strong]
    error = real - judged.component.predicted(judged.selection.chosen.parts, shown)[0, strong]
    assert np.linalg.norm(error) < 0.4 * np.linalg.norm(real)


def test_the_guides_of_a_carriage_rub_as_its_free_vibration_decays() -> None:
    """From the largest displacement on, when the carriage is let go."""
    found = diagnose(plan("free_vibration"), measured("free_vibration", A1_05, start=3.12)).verdict
    assert "coulomb_friction" in {one["id"] for one in found["effects"]}
    assert found["fit"]["extended"]["heldout_nrmse"] < 0.5 * found["fit"]["baseline"]["heldout_nrmse"]


def test_the_drive_of_a_shaking_table_saturates() -> None:
    """Fitted on two sines, shown on a sawtooth; the voltage after the limit, which is recorded too, was left out."""
    fitted, more = (measured("shaking_table", f"Sine{name}.csv") for name in ("A3F08", "A8F4"))
    found = diagnose(plan("shaking_table"), fitted, [measured("shaking_table", "SawtoothA2F05.csv")], more=[more]).verdict
    limits = {one["id"]: one["parameters"][0]["value"] for one in found["effects"]}
    gain = plan("shaking_table").stations[0].actuator.gain  # of a square wave that stays within the limit
    assert limits["velocity_saturation"] / gain == pytest.approx(0.5, rel=0.05)  # V
    assert found["fit"]["extended"]["heldout_nrmse"] < 0.6 * found["fit"]["baseline"]["heldout_nrmse"]
