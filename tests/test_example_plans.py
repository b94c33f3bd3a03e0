"""The example plans are sound."""

from __future__ import annotations

import pytest

from tests.measured_sets import plan
from tests.test_example_mappings import EXAMPLES, example

SETS = sorted(path.parent.name for path in EXAMPLES.glob("*/plan.yaml"))


@pytest.mark.parametrize("name", SETS)
def test_an_example_plan_is_sound_and_of_the_test_that_its_mapping_says(name: str) -> None:
    assert plan(name).test == example(name).test
