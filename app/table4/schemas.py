"""JSON forms of the comparison with Table IV."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import BaseModel, ConfigDict, create_model

from app.runs.schemas import RunOut
from rths_engine.table4.comparison import MEASURES

Pair = tuple[float, float]


class _Paper(BaseModel):
    model_config = ConfigDict(from_attributes=True)


if TYPE_CHECKING:
    _Published = _Paper
else:
    _Published = create_model("Published", __base__=_Paper, **{key: (Pair, ...) for key in MEASURES})


class PaperOut(_Published):
    """The published measures of a stable simulation, for the first and the second station."""


class SimulationOut(BaseModel):
    """One simulation: its compensation, its newest run, and the paper's measures (null if the paper's test was unstable).

    `calibrated`: parameters of the emulated laboratory were fitted to this simulation. `changed`: the plan of the run differs
    from the present plan of the simulation.
    """

    simulation: int
    alpha_es: Pair
    kp: float
    calibrated: bool
    run: RunOut | None
    changed: bool
    paper: PaperOut | None


class TableOut(BaseModel):
    """The comparison with Table IV. Counts are over ended simulations; factors are exp |ln(ours/paper)| of MTE, RMS, MTI."""

    simulations: list[SimulationOut]
    ended: int
    outcomes_right: int
    signs_right: int
    signs: int
    median_factor: float | None
    worst_factor: float | None
    floors_peak_mm: list[float | None] | None
    floors_peak_mm_paper: list[float]
