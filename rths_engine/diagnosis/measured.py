"""The specimens of a plan with what a recording of it holds at their ends."""

from __future__ import annotations

import numpy as np

from rths_engine.diagnosis.component import Specimen, SpecimenData
from rths_engine.errors import Issue, RecordingError
from rths_engine.plan import Plan
from rths_engine.recording import Recording

LEAST = 512  # samples: fewer hold too little to tell noise from physics


def specimens(plan: Plan) -> list[Specimen]:
    """One component a station: its specimen with the effects that the plan has already."""
    return [
        Specimen(f"specimen:{number}", station.specimen, tuple(station.specimen_physics))
        for number, station in enumerate(plan.stations, start=1)
    ]


def checked(plan: Plan, recording: Recording, where: str) -> None:
    """Raises RecordingError where the recording is not one of this plan's stations."""
    have = sum(channel.key.endswith(".f_meas") for channel in recording.channels)
    if not plan.stations:
        raise RecordingError(
            Issue("stations", "the plan has no station, and so no specimen", None, "give a plan with stations")
        )
    if have != len(plan.stations):
        fix = "give the plan of this recording"
        raise RecordingError(Issue(where, f"holds {have} stations; the plan has {len(plan.stations)}", None, fix))
    if not np.isclose(recording.dt, plan.substep, rtol=1e-6):
        problem = f"has {1 / recording.dt:g} samples a second; the plan's controller rate is {plan.controller_rate:g} Hz"
        raise RecordingError(Issue(where, problem, None, "give the plan of this recording"))
    if len(recording.signals) < LEAST:
        raise RecordingError(Issue(where, f"has {len(recording.signals)} samples; a diagnosis needs {LEAST}"))
    if not np.isfinite(recording.signals).all():
        raise RecordingError(Issue(where, "holds values that are not finite numbers"))


def data(recording: Recording, number: int) -> SpecimenData | None:
    """What was measured at station `number`; None where it never moved or never resisted."""
    x, force = recording.signal(f"s{number}.x_meas"), recording.signal(f"s{number}.f_meas")
    if np.ptp(x) == 0 or np.ptp(force) == 0:
        return None
    return SpecimenData(x, force, np.ones(len(x)), recording.dt)
