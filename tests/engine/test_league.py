"""The league of compensators: a short league in one process, its spread, its order and its file."""

from __future__ import annotations

import math

import pytest

from rths_engine.foundation.errors import RthsError
from rths_engine.league import running
from rths_engine.league.criteria import CRITERIA
from rths_engine.league.entries import entries
from rths_engine.league.table import League, Outcome, read, spread, write
from rths_engine.parts import compensators
from rths_engine.planning import vrths
from rths_engine.planning.plan import Plan


@pytest.fixture(scope="module")
def short() -> League:
    """Two compensators, one perturbed plant, 4 s of the record."""
    whole = vrths.benchmark

    def shortened(*given: object, **more: object) -> Plan:
        return whole(*given, **more).model_copy(update={"duration": 4.0})  # type: ignore[arg-type]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(vrths, "benchmark", shortened)
        return running.league(running.Wanted(plants=1, only=("inverse", "ats")), None, 1, "rths league")


def test_the_better_compensator_leads_and_every_criterion_has_a_value(short: League) -> None:
    assert [row.kind for row in short.rows] == ["ats", "inverse"]
    for row in short.rows:
        assert row.nominal.status == "completed" and row.spread.completed == 1
        assert all(row.nominal.criteria[one.symbol] is not None for one in CRITERIA)
    ats, inverse = short.rows
    assert ats.quiet.criteria["J2"] < 0.3 < inverse.quiet.criteria["J2"]  # type: ignore[operator]


def test_a_league_reads_back_from_its_file(short: League) -> None:
    again = read(write(short), "league.json")
    assert [row.digest for row in again.rows] == [row.digest for row in short.rows]
    assert again.rows[0].nominal.criteria["J2"] == pytest.approx(short.rows[0].nominal.criteria["J2"], rel=1e-5)
    with pytest.raises(RthsError, match="is not a league"):
        read("{}", "league.json")


def test_every_compensator_of_the_registry_is_in_the_league_and_the_published_design_beside() -> None:
    rows = entries(1)
    assert [row.kind for row in rows if not row.published] == [kind.model_fields["kind"].default for kind in compensators.KINDS]
    assert [row.kind for row in rows if row.published] == ["pi_phase_lead"]


def test_the_spread_counts_completed_tests_only() -> None:
    values = [{one.symbol: float(number) for one in CRITERIA} for number in (1, 2, 4)]
    found = [Outcome(status="completed", criteria=values[0]), Outcome(status="completed", criteria=values[1])]
    one = spread([*found, Outcome(status="tripped", trip_s=1.0, criteria=values[2])])
    assert (one.completed, one.mean["J2"]) == (2, 1.5)
    assert one.deviation["J2"] == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize(
    ("wanted", "where"),
    [
        (running.Wanted(case=5), "--case"),
        (running.Wanted(plants=-1), "--plants"),
        (running.Wanted(only=("magic",)), "--only"),
        (running.Wanted(record="nowhere"), "record"),
    ],
)
def test_a_league_that_cannot_run_names_the_option(wanted: running.Wanted, where: str) -> None:
    with pytest.raises(RthsError) as refused:
        running.league(wanted, None, 1, "rths league")
    assert where in refused.value.issues[0].where + str(refused.value)
