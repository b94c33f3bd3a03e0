"""The table of measures. Results, database, REST, pages, reports, exports and documents follow from it.

To add a measure, write its function, enter it here and run `make migration MESSAGE="..."` (docs/measures.md).
"""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np

from rths_engine.results import metrics
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure

M = TypeVar("M", bound=Measure)

TESTED = ("hybrid", "specimen", "actuator", "client")
COMPUTED = ("hybrid", "structure")
TABLE_IV = "Chen and Ricles (2012), EESD 41, 549-569, equation (10)"
RIASCOS = "Riascos, Ou and Dyke, Hybrid Simulation Current Assessment Measures (2014)"
GUO = "Guo, Chen, Xu and Christenson (2014)"

# factors and digits are those of the display, the source of each measure is its field: docs/measures.md
MEASURES: tuple[Measure, ...] = (
    StationMeasure(
        key="mte_mm",
        label="MTE",
        symbol="MTE",
        unit="m",
        shown="mm",
        decimals=2,
        tests=TESTED,
        formula="max abs(d_c - d_m)",
        meaning="maximum tracking error",
        source=TABLE_IV,
        listed=True,
        compute=lambda station: metrics.maximum_tracking_error(station.x_cmd, station.x_meas),
        so_far=lambda sums: abs(sums.error),
    ),
    StationMeasure(
        key="rms_percent",
        label="RMS",
        symbol="RMS",
        unit="1",
        shown="%",
        decimals=2,
        tests=TESTED,
        formula="sqrt(sum (d_c - d_m)^2 / sum d_c^2)",
        meaning="root mean square of the tracking error over that of the command; 0 where the command never moved",
        source=TABLE_IV,
        listed=True,
        compute=lambda station: metrics.rms_tracking_error(station.x_cmd, station.x_meas),
        so_far=lambda sums: math.sqrt(sums.error_power / sums.command_power) if sums.command_power > 0 else 0.0,
    ),
    StationMeasure(
        key="mti_mm2",
        label="MTI",
        symbol="MTI",
        unit="m^2",
        shown="mm^2",
        decimals=1,
        tests=("hybrid", "actuator", "client"),
        formula="TI at its largest magnitude",
        meaning="maximum tracking indicator; positive: the actuator lagged, negative: it led",
        source=TABLE_IV,
        compute=lambda station: metrics.signed_peak(metrics.tracking_indicator(station.x_cmd, station.x_meas)),
        so_far=lambda sums: sums.indicator,
    ),
    StationMeasure(
        key="mee_kNm",
        label="MEE",
        symbol="MEE",
        unit="J",
        shown="kN*m",
        decimals=2,
        tests=("hybrid", "client"),
        formula="E at its largest magnitude",
        meaning="maximum energy error of one specimen; negative: lag fed energy into the structure",
        source=TABLE_IV,
        compute=lambda station: station.energy_error,
        so_far=lambda sums: sums.energy,
    ),
    StationMeasure(
        key="peak_stroke_mm",
        label="Peak stroke",
        symbol="max abs(d_m)",
        unit="m",
        shown="mm",
        decimals=1,
        tests=TESTED,
        formula="max abs(d_m)",
        meaning="largest measured displacement",
        source="definition",
        listed=True,
        compute=lambda station: float(np.max(np.abs(station.x_meas), initial=0.0)),
        so_far=lambda sums: abs(sums.stroke),
    ),
    StationMeasure(
        key="peak_force_kN",
        label="Peak force",
        symbol="max abs(r)",
        unit="N",
        shown="kN",
        decimals=1,
        tests=TESTED,
        formula="max abs(r)",
        meaning="largest measured force of one specimen",
        source="definition",
        listed=True,
        compute=lambda station: float(np.max(np.abs(station.f_meas), initial=0.0)),
        so_far=lambda sums: abs(sums.force),
    ),
    StationMeasure(
        key="fei_delay_ms",
        label="FEI delay",
        symbol="d",
        unit="s",
        shown="ms",
        decimals=2,
        tests=TESTED,
        formula="-arg(FEI) / (2 pi f_eq)",
        meaning="generalised delay by the frequency evaluation index; positive: late",
        source=GUO,
        further=True,
        compute=lambda station: station.evaluation and station.evaluation.delay,
        so_far=lambda sums: sums.evaluation and sums.evaluation.delay,
    ),
    StationMeasure(
        key="fei_amplitude",
        label="FEI amplitude",
        symbol="A",
        unit="1",
        shown="1",
        decimals=4,
        tests=TESTED,
        formula="abs(FEI)",
        meaning="generalised amplitude by the frequency evaluation index; below 1: undershoot",
        source=GUO,
        further=True,
        compute=lambda station: station.evaluation and station.evaluation.amplitude,
        so_far=lambda sums: sums.evaluation and sums.evaluation.amplitude,
    ),
    StationMeasure(
        key="delay_ms",
        label="Delay",
        symbol="k dt",
        unit="s",
        shown="ms",
        decimals=2,
        tests=TESTED,
        formula="lag of the largest cross-correlation of d_c and d_m",
        meaning="delay by cross-correlation; positive: late",
        source=RIASCOS,
        further=True,
        compute=lambda station: metrics.correlation_delay(station.x_cmd, station.x_meas, station.dt),
        so_far=lambda sums: sums.delay,
    ),
    StationMeasure(
        key="nrms_percent",
        label="NRMSE",
        symbol="NRMSE",
        unit="1",
        shown="%",
        decimals=2,
        tests=TESTED,
        formula="sqrt(mean (d_c - d_m)^2) / (max d_c - min d_c)",
        meaning="root mean square tracking error over the range of the command",
        source=RIASCOS,
        further=True,
        compute=lambda station: metrics.normalised_rms(station.x_cmd, station.x_meas),
        so_far=lambda sums: math.sqrt(sums.error_power / sums.count) / sums.span if sums.span > 0 else None,
    ),
    StationMeasure(
        key="peak_error_percent",
        label="Peak error",
        symbol="PTE",
        unit="1",
        shown="%",
        decimals=2,
        tests=TESTED,
        formula="max abs(d_c - d_m) / max abs(d_c)",
        meaning="largest tracking error over the largest command",
        source=RIASCOS,
        further=True,
        compute=lambda station: metrics.peak_error(station.x_cmd, station.x_meas),
        so_far=lambda sums: abs(sums.error) / sums.largest_command if sums.largest_command > 0 else None,
    ),
    StationMeasure(
        key="energy_error_percent",
        label="HSEE",
        symbol="HSEE",
        unit="1",
        shown="%",
        decimals=2,
        tests=("hybrid",),
        formula="n MEE / max E_I",
        meaning="energy error of the station's n specimens over the input energy; negative: energy fed in",
        source="after Mosqueda, Stojadinovic and Mahin (2007), J. Struct. Eng. 133, 1140-1148",
        further=True,
        compute=lambda station: metrics.energy_error_ratio(station.energy_error, station.dampers, station.largest_input),
        so_far=lambda sums: metrics.energy_error_ratio(sums.energy, sums.dampers, sums.largest_input),
    ),
    FloorMeasure(
        key="floors_peak_mm",
        label="Floor peak",
        symbol="max abs(x)",
        unit="m",
        shown="mm",
        decimals=1,
        tests=COMPUTED,
        formula="max abs(x)",
        meaning="largest displacement of the floor relative to the ground",
        source="definition",
        listed=True,
        compute=lambda run: [float(np.max(np.abs(x), initial=0.0)) for x in run.floors.T],
    ),
    RunMeasure(
        key="input_energy_kNm",
        label="Input energy",
        symbol="max E_I",
        unit="J",
        shown="kN*m",
        decimals=1,
        tests=COMPUTED,
        formula="max E_I, E_I = -integral (M iota a_g - p) . v dt",
        meaning="largest energy that ground motion and forces on floors put into the structure",
        source="Uang and Bertero (1990), EESD 19, 77-90",
        compute=lambda run: run.largest_input,
        so_far=lambda sums: sums.largest_input,
    ),
)


def of(kind: type[M], test: str | None = None) -> tuple[M, ...]:
    """The measures of a scope, by its class, in their order; with `test`, those that apply in that kind of test."""
    return tuple(one for one in MEASURES if isinstance(one, kind) and (test is None or test in one.tests))


def measure(key: str) -> Measure:
    """The measure named `key`. Raises KeyError where there is none."""
    return {one.key: one for one in MEASURES}[key]
