"""A measure that the product does not have, as `sitecustomize` of a service: each of its processes adds the entry."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from app import db
from rths_engine.results import measures
from rths_engine.results.measure import StationMeasure

measures.MEASURES += (
    StationMeasure(
        key="mean_force_kN",
        label="Mean force",
        symbol="mean abs(r)",
        unit="N",
        shown="kN",
        decimals=3,
        tests=measures.TESTED,
        formula="mean abs(r)",
        meaning="mean magnitude of the measured force of one specimen",
        source="definition",
        listed=True,
        compute=lambda station: float(np.mean(np.abs(station.f_meas))) if len(station.f_meas) else None,
    ),
)
db.MIGRATIONS = Path(__file__).parent / "migrations"
