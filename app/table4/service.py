"""The twelve simulations of Table IV in the queue, and the table from the newest run of each."""

from __future__ import annotations

from functools import lru_cache

from app.jobs.states import State
from app.models import Run
from app.runs.repository import Filter, Page
from app.runs.schemas import RunOut
from app.runs.service import RunService
from app.runs.shelves import Shelf
from app.table4.schemas import PaperOut, SimulationOut, TableOut
from rths_engine import table4 as engine
from rths_engine.table4.comparison import CALIBRATED, FLOORS_PEAK, MEASURES, stable

SHOWN = {State.COMPLETED, State.TRIPPED}


class Table4Service:
    """Queues the simulations of Table IV and compares them with the paper."""

    def __init__(self, runs: RunService):
        self.runs = runs

    def submit(self, by: str) -> list[Run]:
        """Queue the twelve simulations with the bundled record, all or none."""
        plans = [plan.as_dict() for plan in engine.plans(engine.BUNDLED).values()]
        return self.runs.submit(plans, by)

    def table(self) -> TableOut:
        """The newest run of each simulation beside the paper's values, and the comparison."""
        simulations = [self._simulation(number) for number in engine.PAPER]
        ended = {one.simulation: one.run for one in simulations if one.run and one.run.state in SHOWN}
        found = engine.comparison([_row(number, run) for number, run in ended.items()])
        second = ended.get(2)
        return TableOut(
            simulations=simulations,
            ended=len(ended),
            outcomes_right=found.outcomes_right,
            signs_right=found.signs_right,
            signs=found.signs_right + len(found.signs_wrong),
            median_factor=found.median if found.factors else None,
            worst_factor=found.worst if found.factors else None,
            floors_peak_mm=getattr(second, FLOORS_PEAK) if second else None,
            floors_peak_mm_paper=list(engine.FLOORS_PEAK_MM),
        )

    def _simulation(self, number: int) -> SimulationOut:
        found, _ = self.runs.listed(Filter(template=engine.name(number), shelf=Shelf.ALL), Page(limit=1))
        run = RunOut.of(found[0]) if found else None
        paper = engine.PAPER[number]
        return SimulationOut(
            simulation=number,
            alpha_es=paper.alpha_es,
            kp=paper.kp,
            calibrated=number in CALIBRATED,
            run=run,
            changed=run is not None and run.digest != self._digest(number),
            paper=PaperOut.model_validate(paper) if stable(paper) else None,
        )

    def _digest(self, number: int) -> str:
        record = engine.BUNDLED.model_copy(update={"sha256": self.runs.motions.get(engine.BUNDLED.record).sha256})
        return _digests(record)[number]


@lru_cache(maxsize=1)
def _digests(record: engine.PlannedRecord) -> dict[int, str]:
    return {number: plan.digest for number, plan in engine.plans(record).items()}


def _row(number: int, run: RunOut) -> engine.Row:
    stations = [{field: getattr(station, field) or 0.0 for field in MEASURES} for station in run.stations]
    return engine.Row(number, run.state, run.trip["time_s"] if run.trip else None, stations)
