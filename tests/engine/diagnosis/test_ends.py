"""The ends of a recording."""

from __future__ import annotations

import numpy as np

from rths_engine.diagnosis.ends import ENDS, inner, mirrored


def test_the_inner_samples_are_away_from_both_ends() -> None:
    inside = np.flatnonzero(inner(1000, 0.01))
    assert inside[0] == round(ENDS / 0.01) and inside[-1] == 1000 - round(ENDS / 0.01) - 1


def test_what_stands_in_the_ends_does_not_reach_the_mirrored_signal() -> None:
    signal = np.arange(20.0)[None]
    used = (np.arange(20) >= 3) & (np.arange(20) < 18)
    jump = signal.copy()
    jump[:, :3] = jump[:, 18:] = 1e6
    assert np.array_equal(mirrored(jump, used), mirrored(signal, used))
    assert mirrored(signal, used)[0, [0, 1, 2, 3, 17, 18, 19]].tolist() == [6, 5, 4, 3, 17, 16, 15]


def test_a_signal_that_is_used_whole_or_not_at_all_is_left_as_it_is() -> None:
    signal = np.arange(5.0)[None]
    for used in (np.ones(5, bool), np.zeros(5, bool)):
        assert mirrored(signal, used) is signal
