"""`rths deadline`, and the deadlines of a run in its summary, its report and on the terminal."""

from __future__ import annotations

import json

import pytest

from app.cli.main import main
from app.reports.deadlines import deadlines
from app.reports.document import Facts, Table


def test_it_measures_the_steps_of_a_template_at_the_rate_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["deadline", "--rate", "8000", "--steps", "160", "--json"])
    found = json.loads(capsys.readouterr().out)
    assert (found["steps"], found["rate_hz"]) == (160, 8000.0)
    assert code == (1 if found["missed"] else 0)
    assert sum(found["histogram"]["delay"]) == sum(found["histogram"]["length"]) == 160


def test_it_prints_counts_percentiles_verdicts_and_the_histogram(capsys: pytest.CaptureFixture[str]) -> None:
    main(["deadline", "--rate", "8000", "--steps", "80"])
    printed = capsys.readouterr().out
    for text in (
        "of 80 controller steps missed the deadline of 125 µs (8000 Hz)",
        "Worst step:",
        "99.9 %",
        "Would have met: 1024 Hz",
        "These counts take each step's own delay alone",
        "length of work  begin after due",
    ):
        assert text in printed
    assert "ordinary priority" in printed and "length of work" in printed


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--priority", "0"], "priority = 0: needs a value >= 1"),
        (["--core", "-1"], "core = -1: needs a value >= 0"),
        (["--rate", "0"], "--rate = 0.0: is out of range"),
        (["--rate", "nan"], "--rate = nan: is out of range"),
        (["--steps", "0"], "--steps = 0: is out of range"),
        (["--steps", "100000000"], "--steps = 100000000: is out of range"),
        (["--plan", "missing.yaml"], "missing.yaml"),
    ],
)
def test_unusable_options_are_named(options: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["deadline", *options]) == 2
    assert told in capsys.readouterr().err


def test_the_report_has_a_section_of_deadlines_only_for_a_test_in_real_time(capsys: pytest.CaptureFixture[str]) -> None:
    main(["deadline", "--rate", "20000", "--steps", "40", "--json"])
    (section,) = deadlines(json.loads(capsys.readouterr().out))
    tables = [one for one in section.blocks if isinstance(one, Table)]
    verdicts = next(one for one in section.blocks if isinstance(one, Facts))
    assert [label for label, _ in verdicts.rows] == [
        "Would have met 1024 Hz",
        "Would have met 2048 Hz",
        "Would have met 4096 Hz",
    ]
    assert sum(int(row[1]) for row in tables[1].rows) == 40
    assert deadlines(None) == []
