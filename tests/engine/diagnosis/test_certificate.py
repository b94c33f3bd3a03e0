"""The error rates that a verdict cites."""

from __future__ import annotations

from rths_engine.diagnosis.certificate import line


def test_a_kind_without_a_line_has_no_certificate() -> None:
    assert line("nothing of this kind") is None


def test_a_line_has_the_rates_of_its_kind_with_their_counts() -> None:
    found = line("specimen")
    if found is None:
        return
    assert found.kind == "specimen" and found.false_discovery.count > 0
    for rate in (found.false_alarm, found.false_discovery, found.power):
        assert rate.value is None or (rate.wilson95 is not None and rate.wilson95[0] <= rate.value <= rate.wilson95[1])
