"""Diagnosis of a plan: compare its models with a recording."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from rths_engine.diagnosis import digital, recorded
from rths_engine.diagnosis.components import Actuator, Specimen
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.extend import extended
from rths_engine.diagnosis.judge import Judged, judged
from rths_engine.diagnosis.remaining import Remaining, remaining
from rths_engine.diagnosis.result import verdict_of
from rths_engine.diagnosis.schema import Verdict
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured

Told = Callable[[str, float], None]


@dataclass(frozen=True)
class Diagnosis:
    """The result of a diagnosis: judgements of all components, replays of all computed parts, and the verdict on the plan.

    `left` is what no named effect explains, by the name of the component.
    """

    plan: Plan
    judged: tuple[Judged, ...]
    digital: tuple[Replayed, ...]
    verdict: Verdict
    left: dict[str, Remaining]


def diagnose(
    plan: Plan,
    recording: Measured,
    heldout: Sequence[Measured] = (),
    level: float = 0.01,
    seed: int = 0,
    more: Sequence[Measured] = (),
    told: Told = lambda what, share: None,
) -> Diagnosis:
    """Compare the models of a plan with a recording.

    `more` recordings are fitted together with the first. `heldout` recordings are never fitted; without them, three of ten
    blocks of the recording are held out. The replays cover the whole recording. `level` is the false-alarm rate of the
    diagnosis, which is divided equally among the components (Bonferroni). `told` receives the name of the component in
    progress and the share of the work that is done; it may raise an exception to stop the diagnosis.

    Linear algebra runs in one thread meanwhile: the threads of the replays use the cores, and threads of OpenBLAS that wait for
    each other took six times the processor time of the whole diagnosis.

    Raises RecordingError where a recording does not match the plan. Its issues name the input by its argument: `recording`,
    `heldout.0`, `more.0`.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        pairs = recorded.components(plan, recording, "recording")
        wrong_units = recorded.suspicious(pairs)
        if wrong_units:
            raise RecordingError([Issue("recording", problem) for problem in wrong_units])
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
        left = {one.component.name: rest for one in found if (rest := remaining(plan, one, each)) is not None}
        verdict = verdict_of(plan, found, replayed, each, plan_after, left)
        return Diagnosis(plan, tuple(found), tuple(replayed), verdict, left)


def _by_name(plan: Plan, recording: Measured, where: str) -> dict[str, Any]:
    return {component.name: data for component, data in recorded.components(plan, recording, where)}


def _title(plan: Plan, name: str) -> str:
    kind, _, number = name.partition(":")
    return f"{kind} of {plan.stations[int(number) - 1].name}" if number else kind
