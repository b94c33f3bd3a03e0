"""A recorded current, coil voltage or temperature drives the specimen of a diagnosis."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.components import Specimen, SpecimenData
from rths_engine.diagnosis.recorded import components
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.specimens.mr_damper_current import MrDamperCurrent
from rths_engine.planning.plan import ROOM
from rths_engine.recordings.measured import Measured, MeasuredChannel
from tests.engine import recorded_specimens

PART = MrDamperCurrent()
DT = 1 / recorded_specimens.RATE
TIME = DT * np.arange(2048)
X = 0.02 * np.sin(2 * np.pi * TIME)
CURRENT = 1.25 + 1.25 * np.sign(np.sin(2 * np.pi * 0.4 * TIME))
CONSTANT = {"kind": "constant", "current": 1.2}
CLIPPED = {"kind": "clipped_optimal"}
UNITS = {"x_meas": "m", "f_meas": "N", "current": "A", "coil_voltage": "V", "temperature": "K"}


def specimen(controller: dict[str, Any], more: dict[str, Array], **station: Any) -> tuple[Specimen, SpecimenData]:
    """The component of an MR damper with current in a recording with more channels."""
    channels = {"x_meas": X, "f_meas": 1e5 * np.sign(np.gradient(X)), **more}
    recording = Measured(DT, tuple(MeasuredChannel(role, 1, values, UNITS[role]) for role, values in channels.items()))
    plan = recorded_specimens.plan(PART, controller=controller, **station)
    component, data = next(one for one in components(plan, recording, "recording") if isinstance(one[1], SpecimenData))
    assert isinstance(component, Specimen)
    return component, data


def test_a_recorded_current_drives_the_specimen() -> None:
    component, data = specimen(CLIPPED, {"current": CURRENT})
    assert component.base[0] == PART
    np.testing.assert_array_equal(data.current, CURRENT)
    assert {one.id for one in component.hypotheses(data)} >= {"strength_against_current", "residual_field", "current_lag"}


@pytest.mark.parametrize(("resistance", "ohms"), [(4.0, 4.0), (None, 1.0)])
def test_a_coil_voltage_is_a_current_over_the_resistance(resistance: float | None, ohms: float) -> None:
    _, data = specimen(CLIPPED, {"coil_voltage": CURRENT}, coil_resistance=resistance)
    np.testing.assert_allclose(data.current, CURRENT / ohms, rtol=1e-15)


def test_without_a_recorded_current_a_constant_controller_gives_it_and_the_passive_damper_is_fitted() -> None:
    component, data = specimen(CONSTANT, {})
    assert component.base[0] == PART.at(1.2) and isinstance(component.base[0], MrDamper)
    assert not {"strength_against_current", "residual_field"} & {one.id for one in component.hypotheses(data)}


def test_a_varying_current_that_was_not_recorded_is_asked_for() -> None:
    with pytest.raises(RecordingError, match=r"no current of station 1.*role current or coil_voltage"):
        specimen(CLIPPED, {})


def test_a_recorded_temperature_drives_the_specimen() -> None:
    warm = ROOM + 10 * TIME
    component, data = specimen(CONSTANT, {"temperature": warm})
    assert data.seen().temperature == pytest.approx(np.mean(warm))
    (effect, _) = (one for one in component.hypotheses(data) if one.id == "strength_against_temperature")
    cold = component.force(component.base, data)
    ratio = component.force((*component.base, effect.model_copy(update={"coefficient": 0.02, "reference": ROOM})), data) / cold
    np.testing.assert_allclose(ratio[1:], np.exp(-0.2 * TIME[1:]), rtol=1e-9)


def test_a_temperature_that_does_not_change_offers_no_effect() -> None:
    component, data = specimen(CONSTANT, {"temperature": np.full(len(X), 300.0)}, temperature=310.0)
    assert np.ptp(data.temperature) == 0.0 and data.seen().temperature == pytest.approx(300.0)
    assert "strength_against_temperature" not in {one.id for one in component.hypotheses(data)}
