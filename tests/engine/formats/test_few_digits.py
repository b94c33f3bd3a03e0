"""Times of six digits: equal steps come back, and nothing else is taken for equal steps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.few_digits import equal_steps, last_digit, start


def six(values: np.ndarray) -> np.ndarray:
    return np.array([float(f"{one:.6g}") for one in values])


@settings(max_examples=40)
@given(
    st.sampled_from([1e-3, 1 / 1024, 1 / 2048, 0.005, 0.0123456789]),
    st.floats(0, 5000, allow_subnormal=False),
    st.integers(0, 3000),
)
def test_equal_steps_come_back_from_any_start(step: float, begin: float, more: int) -> None:
    count = 200 + more + int(200 * 10 ** (np.floor(np.log10(begin + 1)) - 5) / step)  # 200 units at least
    stamps = six(begin + np.arange(count) * step)
    found = equal_steps(stamps)
    assert found is not None
    assert found.smallest <= step <= found.largest
    index, margin = np.arange(count), 0.51 * last_digit(stamps) + 1e-12 * stamps[-1]
    for one in (step, found.step):
        assert (np.abs(start(stamps, one) + one * index - stamps) <= margin).all()


T = 150.0 + np.arange(1200) / 1024


@pytest.mark.parametrize(
    "values",
    [
        T,  # with all its digits
        six(np.delete(T, 600)),  # a sample is missing
        six(T[::-1]),
        np.full(1200, 150.001),
        six(150 + 0.001 * (np.arange(1200) > 600)),  # a constant whose last digit changes
        six(T + 0.002 * np.sin(np.arange(1200) / 100)),  # a clock that wanders by two units of the last digit
        np.floor(np.arange(1200) / 5) / 50,  # five stamps of 20 ms each
        np.array([np.nan, *six(T)]),
        np.array([1.0, 2.0]),
    ],
)
def test_other_values_are_not_equal_steps(values: np.ndarray) -> None:
    assert equal_steps(values) is None


def test_the_unit_of_the_last_digit_grows_with_the_value() -> None:
    assert last_digit(np.array([0.0, 0.5, 9.99999, 10.0, 100.0, 999.999, 1000.0])) == pytest.approx(
        [1e-6, 1e-6, 1e-5, 1e-4, 1e-3, 1e-3, 1e-2]
    )
