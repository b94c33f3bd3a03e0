"""The recording of a run as a measured recording."""

from __future__ import annotations

from typing import Any

from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.roles import ROLES
from rths_engine.recordings.run_file import Recording


def of_run(recording: Recording, name: str) -> Measured:
    """The channels that a laboratory measures, without derived channels such as the tracking error."""
    found = tuple(
        MeasuredChannel(one.role, one.number, recording.signal(one.key), one.unit, one.label, one.key)
        for one in recording.channels
        if one.role in ROLES
    )
    plan = recording.plan
    attrs: dict[str, Any] = {
        "title": plan.name,
        "test": plan.test,
        "source": name,
        "source_sha256": str(recording.attrs["digest"]),
    }
    return Measured(recording.dt, found, recording.dt, **attrs, of_run=True)
