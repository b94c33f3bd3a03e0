"""The words for what no named effect explains: parity, size, share and formula."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.components.features import Sizes
from rths_engine.diagnosis.described import formula, law_terms, sentence, shown, state
from rths_engine.diagnosis.locate import Place
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.diagnosis.unknown import Law, Term
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.test_surface import COUNT, TOP_X, V, X, surface

SIZES = Sizes(0.02, 0.126, 1.0, 4e4, 3200.0, 40.0)
PLACE = Place([(1.0, 2.0), (3.0, 4.0), (5.0, 6.0), (7.0, 8.0)], [(0.5, 3.0)], "", np.zeros(1), np.zeros(1))


def remaining(extra: Array, law: Law | None = None, share: float | None = 0.9) -> Remaining:
    return Remaining("N", 1234.0, "", (surface(extra),), share, law, PLACE, None)


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (3e3 * np.sign(V), "odd in velocity (the recording dissipates more energy than the model)"),
        (-3e3 * np.sign(V), "odd in velocity (the recording dissipates less energy than the model)"),
        (3e3 * (X / TOP_X) ** 3, "odd in displacement and even in velocity (elastic)"),
        (3e3 * (X / TOP_X) ** 2, "even in displacement and in velocity (an asymmetry)"),
    ],
)
def test_the_parity_of_a_force_is_said(extra: Array, words: str) -> None:
    assert f"It is {words}" in state(remaining(extra))


def test_noise_shows_no_dependence_on_the_state() -> None:
    assert "It shows no clear dependence on displacement and velocity." in state(remaining(np.zeros(COUNT)))


def test_the_sentence_has_size_times_band_and_what_the_surface_leaves() -> None:
    found = sentence(remaining(3e3 * np.sign(V), share=0.3), "damper")
    assert found.startswith(
        "The unexplained force of the damper is 1.23 kN RMS, from 1.0 to 2.0 s, 3.0 to 4.0 s, 5.0 to 6.0 s and 1 more spans, "
        "at 0.5 to 3 Hz."
    )
    assert "explains 30 % of it on held-out data; the rest changes within a cell" in found
    assert found.endswith("Held-out data confirm no formula.")


def test_the_formula_has_shown_units_and_the_values_that_divide_its_symbols() -> None:
    terms = (
        Term(1200.0, "|x| v", "a damping that grows with displacement", "", SIZES),
        Term(-340.0, "sin(2 pi x / 3 mm) sgn(v)", "friction periodic in displacement", "", SIZES),
    )
    left = remaining(3e3 * np.sign(V), Law(terms, 0.9, 0.8))
    assert formula(left) == "1.2 kN |x| v -0.34 kN sin(2 pi x / 3 mm) sgn(v), with x in 20 mm, v in 126 mm/s"
    first, second = law_terms(left)
    assert [(scale.symbol, scale.value, scale.unit) for scale in first.scales] == [("x", 0.02, "m"), ("v", 0.126, "m/s")]
    assert not second.scales and (second.coefficient, second.unit) == (-340.0, "N")
    assert "The formula explains 80 % of it on held-out data." in sentence(left, "damper")


def test_energies_times_and_accelerations_have_shown_units() -> None:
    assert [shown(3200.0, "J"), shown(40.0, "s"), shown(1.5, "m/s^2")] == ["3.2 kJ", "40 s", "1.5 m/s²"]


def test_a_structure_without_a_confirmed_storey_force_gets_no_size_and_no_shape() -> None:
    found = sentence(replace(remaining(3e3 * np.sign(V)), size=float("nan")), "structure")
    assert found.startswith("The structure has a residual, from 1.0 to 2.0 s") and " N " not in found
    assert "Held-out data confirm no force that depends on the drift" in found and "odd in velocity" not in found
