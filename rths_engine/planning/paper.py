"""What Chen and Ricles (2012), EESD 41, 549-569, publish of their test: Tables III and IV, dampers, capacities of actuators."""

from __future__ import annotations

from dataclasses import dataclass

# Chen and Ricles (2012), section 4
FORCE_CAPACITY = (2.3e6, 1.7e6)  # N
VELOCITY_CAPACITY = (0.56, 0.76)  # m/s
DAMPERS = (6, 4)
HEIGHTS = (4.57, 3.96)  # m


@dataclass(frozen=True, slots=True)
class PaperRow:
    """One row of Tables III and IV: compensation, and the measures of both stations, or None where the test was unstable."""

    simulation: int
    alpha_es: tuple[float, float]
    kp: float  # 1/mm^2
    mte_mm: tuple[float, float] | None
    rms_percent: tuple[float, float] | None
    mti_mm2: tuple[float, float] | None
    mee_kNm: tuple[float, float] | None


# Chen and Ricles (2012), Tables III and IV
_ROWS = (
    PaperRow(1, (1, 1), 0.0, None, None, None, None),
    PaperRow(2, (1, 1), 0.4, (2.0, 3.2), (2.5, 5.2), (46.8, 73.5), (-5.5, -6.2)),
    PaperRow(3, (30, 30), 0.0, (0.6, 2.3), (1.3, 3.7), (9.1, 160.2), (-2.4, -3.4)),
    PaperRow(4, (30, 30), 0.4, (0.8, 1.6), (1.4, 2.0), (11.8, 48.1), (-2.6, -2.3)),
    PaperRow(5, (60, 60), 0.0, (5.9, 3.9), (11.2, 7.7), (-790.7, -269.9), (-2.9, -1.4)),
    PaperRow(6, (60, 60), 0.4, (1.6, 1.8), (2.8, 3.3), (-53.0, -31.9), (-3.2, -3.8)),
    PaperRow(7, (1, 45), 0.0, None, None, None, None),
    PaperRow(8, (1, 60), 0.0, (6.3, 4.1), (12.7, 8.9), (1304.2, -454.2), (-22.7, -2.9)),
    PaperRow(9, (1, 60), 0.4, (1.1, 1.9), (2.4, 3.0), (52.7, -31.2), (-4.0, -2.1)),
    PaperRow(10, (30, 1), 0.0, None, None, None, None),
    PaperRow(11, (60, 1), 0.0, (6.8, 9.3), (12.2, 18.2), (-1088.8, 1014.5), (-5.0, -27.7)),
    PaperRow(12, (60, 1), 0.4, (1.5, 1.9), (2.7, 3.9), (-55.5, 90.0), (-2.8, -4.6)),
)
PAPER = {f"table3-{row.simulation:02d}": row for row in _ROWS}
