"""The Coulomb friction of a carriage's guides is named where its measured free vibration decays by it."""

from __future__ import annotations

import math

import pytest

from rths_engine.diagnosis.verdict import Diagnosis, diagnose
from rths_engine.planning.reading import read_plan
from tests.measured_sets import heldout, measured, plan

# mass kg, period s, damping ratio as published; displacement m and time s of the largest displacement, at which it is let go
DECAYS = {
    "A1-03": (570.0, 0.26, 0.0546, 0.0087, 3.56),
    "A1-05": (356.9, 0.35, 0.0316, 0.0257, 3.12),
    "A1-06": (453.8, 0.40, 0.0573, 0.0157, 3.38),
}


def diagnosed(name: str) -> Diagnosis:
    mass, period, ratio, start, begun = DECAYS[name]
    carriage = plan("free_vibration").model_dump(mode="json", exclude_none=True)
    storeys = [{"mass": mass, "stiffness": mass * (2 * math.pi / period) ** 2}]
    carriage["structure"] = {"kind": "shear_building", "damping_ratio": ratio, "storeys": storeys}
    carriage["start"] = {"displacement": [start]}
    return diagnose(read_plan(carriage), measured("free_vibration", f"{name}_Disp_Free_Vibration_History.txt", start=begun))


@pytest.mark.parametrize("name", DECAYS)
def test_the_guides_of_a_carriage_rub_as_its_free_vibration_decays(name: str) -> None:
    found = diagnosed(name).verdict
    assert next(one.id for one in found.effects if one.id != "unknown") == "coulomb_friction"
    assert heldout(found, "extended") < 0.5 * heldout(found, "baseline")
