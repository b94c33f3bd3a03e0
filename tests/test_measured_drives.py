"""What the simple models of measured drives leave out is named, and shown on what was not fitted."""

from __future__ import annotations

import pytest

from rths_engine.diagnosis.verdict import diagnose
from rths_engine.parts.actuators.velocity_drive import VelocityDrive
from tests.measured_sets import heldout, measured, plan


def test_the_carriage_rubs_on_its_guides() -> None:
    """Fitted on the first two thirds, shown on the last."""
    fitted, kept = measured("emps", "DATA_EMPS.mat", stop=16.56), measured("emps", "DATA_EMPS.mat", start=16.56)
    found = diagnose(plan("emps"), fitted, [kept]).verdict
    assert found.effects[0].id == "coulomb_friction"
    friction = found.effects[0].parameters[0]
    low, high = friction.ci90
    assert low < 20.7 < high < 1.25 * low  # Janot, Gautier and Brunot (2019)
    assert heldout(found, "baseline") > 0.15
    assert heldout(found, "extended") < 0.035


def test_the_drive_of_a_shaking_table_saturates() -> None:
    """Fitted on two sines, shown on a sawtooth; the voltage after the limit, which is recorded too, was left out."""
    fitted, more = (measured("shaking_table", f"Sine{name}.csv") for name in ("A3F08", "A8F4"))
    found = diagnose(plan("shaking_table"), fitted, [measured("shaking_table", "SawtoothA2F05.csv")], more=[more]).verdict
    limits = {one.id: one.parameters[0].value for one in found.effects}
    drive = plan("shaking_table").stations[0].actuator
    assert isinstance(drive, VelocityDrive)  # its gain: of a square wave that stays within the limit
    assert limits["velocity_saturation"] / drive.gain == pytest.approx(0.5, rel=0.05)  # V
    assert heldout(found, "extended") < 0.6 * heldout(found, "baseline")
