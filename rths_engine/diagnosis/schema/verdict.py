"""`rths-diagnosis/1`: the verdict of a diagnosis, read by people, pages and programs."""

from __future__ import annotations

from typing import Any, Literal

from rths_engine.diagnosis.schema.components import ComponentVerdict, Kind, Where
from rths_engine.diagnosis.schema.effects import Candidate, NamedEffect, NextTest
from rths_engine.diagnosis.schema.fit import Fit, Unexplained
from rths_engine.diagnosis.schema.form import Form, field


class Verdict(Form):
    """What a recording says of the models of a plan, as `rths-diagnosis/1`."""

    version: Literal["rths-diagnosis/1"] = field("Name and version of this form", default="rths-diagnosis/1", alias="schema")
    verdict: Kind = field("Verdict on the whole: that of the worst component")
    components: tuple[ComponentVerdict, ...] = field("Every component that was replayed; computed parts first")
    where: Where | None = field("Where the worst component differs; null where it agrees with its recording")
    effects: tuple[NamedEffect, ...] = field("What was left out, the most probable of each component first")
    candidates: tuple[Candidate, ...] = field(
        "Models of the worst component, ranked by evidence, the first eight; their probabilities sum to at most 1"
    )
    indistinguishable: tuple[tuple[str, ...], ...] = field(
        "Groups of candidates that this recording cannot separate, each its effects as component/id separated by commas"
    )
    fit: Fit = field("Errors of the worst component before and after the extension")
    unexplained: Unexplained = field("What remains of the worst component beyond the extended model and the noise")
    next_test: NextTest | None = field("Test that separates candidates; null where none needs separating or no test does")
    extended_plan: dict[str, Any] | None = field("The plan with the effects in it; null where no effect can be added")
