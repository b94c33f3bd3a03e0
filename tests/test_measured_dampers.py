"""What the simple models of measured dampers leave out is named, and shown on what was not fitted."""

from __future__ import annotations

import numpy as np

from rths_engine.diagnosis.verdict import diagnose
from tests.measured_sets import heldout, measured, plan


def test_an_mr_damper_yields() -> None:
    found = diagnose(plan("mr_damper"), measured("mr_damper", "ensaio1.1.csv")).verdict
    assert {"coulomb_friction", "stribeck_friction", "bouc_wen_hysteresis"} & {one.id for one in found.effects}
    assert heldout(found, "extended") < 0.5 * heldout(found, "baseline")


def test_the_band_of_a_friction_damper_is_slack() -> None:
    """Fitted on two sines, shown on the displacements of an earthquake, over its strong part."""
    fitted, more = (measured("brfd", f"{rate}Hz36lbtension1amplitude.json") for rate in ("0.5", "1"))
    found = diagnose(plan("brfd"), fitted, [measured("brfd", "ImperialValleyDBE.json")], more=[more])
    numbers = {one.id: one.parameters[0].value for one in found.verdict.effects if one.parameters}
    assert 3e-3 < numbers["backlash"] < 5e-3
    assert -0.2 < numbers["asymmetry"] < -0.05
    judged = found.judged[0]
    shown = judged.heldout[0]
    strong = (shown.time >= 3.0) & (shown.time <= 7.5)
    real = shown.measured[0, strong]
    error = real - judged.component.predicted(judged.selection.chosen.parts, shown)[0, strong]
    assert np.linalg.norm(error) < 0.35 * np.linalg.norm(real)
