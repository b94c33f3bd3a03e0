"""What a recording says of a plan's models, as `rths-diagnosis/1`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.diagnosis import digital, recorded
from rths_engine.diagnosis.components import Actuator, Specimen
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.extend import extended
from rths_engine.diagnosis.judge import Judged, judged
from rths_engine.diagnosis.result import as_dict
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured

Told = Callable[[str, float], None]


@dataclass(frozen=True)
class Diagnosis:
    """Every component judged, digital parts replayed; `verdict` is the JSON by contract."""

    plan: Plan
    judged: tuple[Judged, ...]
    digital: tuple[Replayed, ...]
    verdict: dict[str, Any]


def diagnose(
    plan: Plan,
    recording: Measured,
    heldout: Sequence[Measured] = (),
    level: float = 0.01,
    seed: int = 0,
    more: Sequence[Measured] = (),
    told: Told = lambda what, share: None,
) -> Diagnosis:
    """Every component of the plan against the recording, and `more` recordings fitted with it.

    The replays run over the whole recording; the `heldout` recordings are never fitted, or, without one, three of ten blocks.
    `level` is the chance of a false alarm in any component, an equal share of it in each (Bonferroni). `told` hears what is
    done and the share of the whole; it may raise to stop. Raises RecordingError for a recording that is not of this plan.
    """
    pairs = recorded.components(plan, recording, "REC.h5")
    doubts = recorded.suspicious(pairs)
    if doubts:
        raise RecordingError([Issue("REC.h5", doubt) for doubt in doubts])
    beside = [_by_name(plan, one, "--with") for one in more]
    others = [_by_name(plan, one, "--holdout") for one in heldout]
    replayed = digital.replayed(plan, recording)
    random = np.random.default_rng(seed)
    found = []
    each = level / len(pairs)
    first = {component.name: data for component, data in pairs}
    specimens = {component.station: component for component, _ in pairs if isinstance(component, Specimen)}
    for place, (component, _) in enumerate(pairs):
        name = _title(plan, component.name)
        fitted = [one[component.name] for one in (first, *beside) if component.name in one]
        kept = [one[component.name] for one in others if component.name in one]

        def share(done: float, place: int = place, name: str = name) -> None:
            told(name, (place + done) / len(pairs))

        share(0.0)
        found.append(judged(component, name, fitted, kept, each, random, share))
        pressed = specimens.get(component.station)
        if isinstance(component, Actuator) and pressed is not None:
            for one in (first, *beside, *others):
                recorded.foreseen(component, found[-1].selection.chosen.parts, pressed, one)
    told("", 1.0)
    plan_after = extended(plan, found)
    return Diagnosis(plan, tuple(found), tuple(replayed), as_dict(plan, found, replayed, each, plan_after))


def _by_name(plan: Plan, recording: Measured, where: str) -> dict[str, Any]:
    return {component.name: data for component, data in recorded.components(plan, recording, where)}


def _title(plan: Plan, name: str) -> str:
    kind, _, number = name.partition(":")
    return f"{kind} of {plan.stations[int(number) - 1].name}" if number else kind
