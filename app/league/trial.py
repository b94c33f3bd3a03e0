"""Published figures of the benchmark from another program, shown beside our rows without sensor noise."""

from __future__ import annotations

from pydantic import BaseModel

from rths_engine.league.table import League, Row
from rths_engine.planning.vrths import EL_CENTRO, INTENSITY


class Figures(BaseModel):
    """J1 (ms) and J2 (%) of a compensator in another program; `published`: the published design of that kind."""

    kind: str
    published: bool = False
    j1_ms: float
    j2_percent: float
    why: str = ""


class Trial(BaseModel):
    """Figures of another program: their source, what was measured, and the compensators."""

    source: str
    case: int
    record: str
    intensity: float
    sensor_noise: bool
    figures: list[Figures]

    def beside(self, row: Row) -> Figures | None:
        """The figures of the same compensator as a row of ours."""
        return next((one for one in self.figures if (one.kind, one.published) == (row.kind, bool(row.published))), None)


TRIAL = Trial(
    source="an independent trial of the benchmark in another program, without sensor noise",
    case=1,
    record=EL_CENTRO,
    intensity=INTENSITY,
    sensor_noise=False,
    figures=[
        Figures(
            kind="none",
            j1_ms=12,
            j2_percent=56,
            why="Our loop without compensation is predicted unstable about rest (3.54 Hz, damping ratio -2.86 %): the motion "
            "grows until the measured force reaches its limit of 8.9 kN at 5.44 s. With wide limits, our test completes with "
            "J1 21.6 ms and J2 51.2 %. The trial gives a J1 of 12 ms, probably because the published script searches only 49 "
            "samples.",
        ),
        Figures(
            kind="pi_phase_lead",
            published=True,
            j1_ms=4.64,
            j2_percent=10.1,
            why="The published sample controller of the benchmark.",
        ),
        Figures(
            kind="inverse",
            j1_ms=1.71,
            j2_percent=5.98,
        ),
        Figures(
            kind="aic",
            j1_ms=1.95,
            j2_percent=6.88,
            why="Our J1 is the lag of the largest cross-correlation, interpolated between samples; 0.000 ms is no rounding to "
            "a whole sample. Our gains follow from the expected motion and adapt α until the mean delay is gone; J2 remains, "
            "because the amplitude is 6.5 % too large. The gains of the trial are not known; they probably adapt more slowly.",
        ),
        Figures(
            kind="ats",
            j1_ms=0,
            j2_percent=0.22,
            why="The trial fitted by windowed least squares, like ATS but not the same.",
        ),
    ],
)


def trial(league: League) -> Trial | None:
    """The figures to show beside a league; None where it was measured otherwise."""
    same = (league.case, league.record, league.intensity) == (TRIAL.case, TRIAL.record, TRIAL.intensity)
    return TRIAL if same else None
