"""JSON forms of the comparison with Table IV."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

from app.runs.schemas import RunOut

Pair = tuple[float, float]


class PaperOut(BaseModel):
    """The published measures of a simulation that was stable, first and second station."""

    model_config = ConfigDict(from_attributes=True)

    mte_mm: Pair
    rms_percent: Pair
    mti_mm2: Pair
    mee_kNm: Pair


class SimulationOut(BaseModel):
    """One simulation: its compensation, its newest run, and the paper's measures (null where it was unstable).

    `calibrated`: parameters of the emulated laboratory were chosen on it. `changed`: the run's plan is not the page's.
    """

    simulation: int
    alpha_es: Pair
    kp: float
    calibrated: bool
    run: RunOut | None
    changed: bool
    paper: PaperOut | None


class TableOut(BaseModel):
    """Counts are of the simulations that ran to an end; factors are exp |ln(ours/paper)| of MTE, RMS and MTI."""

    simulations: list[SimulationOut]
    ended: int
    outcomes_right: int
    signs_right: int
    signs: int
    median_factor: float | None
    worst_factor: float | None
    floors_peak_mm: list[float | None] | None
    floors_peak_mm_paper: list[float]
