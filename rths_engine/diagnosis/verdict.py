"""Diagnose a plan's models by a recording."""

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
from rths_engine.diagnosis.result import verdict_of
from rths_engine.diagnosis.schema import Verdict
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured

Told = Callable[[str, float], None]


@dataclass(frozen=True)
class Diagnosis:
    """Every component judged, every computed part replayed, and the verdict on the plan."""

    plan: Plan
    judged: tuple[Judged, ...]
    digital: tuple[Replayed, ...]
    verdict: Verdict


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
    done and the share of the whole; it may raise to stop.

    Raises RecordingError for a recording that is not of this plan. Its issues name the input by its argument: `recording`,
    `heldout.0`, `more.0`.
    """
    pairs = recorded.components(plan, recording, "recording")
    doubts = recorded.suspicious(pairs)
    if doubts:
        raise RecordingError([Issue("recording", doubt) for doubt in doubts])
    beside = [_by_name(plan, one, f"more.{number}") for number, one in enumerate(more)]
    others = [_by_name(plan, one, f"heldout.{number}") for number, one in enumerate(heldout)]
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
    return Diagnosis(plan, tuple(found), tuple(replayed), verdict_of(plan, found, replayed, each, plan_after))


def _by_name(plan: Plan, recording: Measured, where: str) -> dict[str, Any]:
    return {component.name: data for component, data in recorded.components(plan, recording, where)}


def _title(plan: Plan, name: str) -> str:
    kind, _, number = name.partition(":")
    return f"{kind} of {plan.stations[int(number) - 1].name}" if number else kind
