"""The prior odds of events in time, and the trend that decides on them."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.parts.physics import SEARCHES
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import EVENT, TRENDING, trend
from rths_engine.parts.physics.specimen import StrengthDrop
from rths_engine.parts.physics.structure import Softening, StiffnessDrop
from tests.engine.effects import SEEN

TIME = np.linspace(0, 30, 3001)


def test_a_decay_trends_by_its_decrement_and_a_steady_motion_does_not() -> None:
    wave = np.sin(2 * np.pi * 1.3 * TIME)
    assert trend(wave) == pytest.approx(0.0, abs=1e-3)
    assert trend(np.exp(-0.1 * TIME) * wave) == pytest.approx(-0.1 * 20, rel=0.02)  # from the first to the last third
    assert trend(np.zeros(30)) == 0.0


@pytest.mark.parametrize("effect", [StrengthDrop(share=0.2, time=5.0), StiffnessDrop(share=0.2, time=5.0)])
def test_an_event_has_lower_prior_odds_where_the_amplitude_changes_and_cautions(effect: Effect) -> None:
    search = SEARCHES[type(effect)]
    steady, changing = SEEN._replace(trend=0.0), SEEN._replace(trend=-2 * TRENDING)
    assert (search.doubt(effect, steady), search.doubt(effect, changing)) == (0.0, EVENT)
    assert search.doubt(effect, SEEN._replace(trend=TRENDING / 2)) == pytest.approx(EVENT / 2)
    assert not search.caution(steady) and "falls over the recording" in search.caution(changing)
    assert "grows" in search.caution(SEEN._replace(trend=2 * TRENDING))


def test_a_law_of_the_amplitude_keeps_its_prior_odds_whatever_the_amplitude_does() -> None:
    softening = SEARCHES[Softening]
    assert softening.doubt(Softening(share=0.2), SEEN._replace(trend=-3.0)) == 0.0
    assert softening.caution(SEEN._replace(trend=-3.0)) == ""
