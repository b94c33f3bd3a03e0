"""Random plans within their declared bounds, run for a short time; a longer run: `python -m tests.fuzz --only plans`."""

from __future__ import annotations

from tests.fuzz import plans


def test_a_random_valid_plan_completes_trips_with_a_reason_or_is_refused() -> None:
    found = list(plans.faults(60, seed=1))
    assert found == [], "\n".join(found)
