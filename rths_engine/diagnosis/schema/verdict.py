"""`rths-diagnosis/1`: the verdict of a diagnosis, for people, pages and programs."""

from __future__ import annotations

from typing import Any, Literal

from rths_engine.diagnosis.schema.certificate import Certificate
from rths_engine.diagnosis.schema.components import ComponentVerdict, Kind, Where
from rths_engine.diagnosis.schema.effects import Candidate, NamedEffect, NextTest, RejectedEffect
from rths_engine.diagnosis.schema.fit import Fit
from rths_engine.diagnosis.schema.form import NUMBERS, Form, field
from rths_engine.diagnosis.schema.unexplained import Unexplained


class Verdict(Form):
    """The verdict on the models of a plan, from the comparison with a recording, as `rths-diagnosis/1`."""

    version: Literal["rths-diagnosis/1"] = field("Name and version of this form", default="rths-diagnosis/1", alias="schema")
    verdict: Kind = field("Verdict on the plan: the verdict on the worst component")
    components: tuple[ComponentVerdict, ...] = field("All replayed components; computed parts first")
    where: Where | None = field("Location of the mismatch of the worst component; null where this component agrees")
    effects: tuple[NamedEffect, ...] = field("Named effects; for each component, the most probable effect first")
    candidates: tuple[Candidate, ...] = field(
        "The first eight candidates of the worst component, ranked by evidence; their probabilities sum to at most 1"
    )
    indistinguishable: tuple[tuple[str, ...], ...] = field(
        "Groups of candidates that this recording does not separate; each candidate is a list of effects, component/id, "
        "separated by commas"
    )
    fit: Fit = field("Errors of the worst component before and after the extension")
    unexplained: Unexplained = field("Residual of the worst component beyond the extended model and the noise")
    next_test: NextTest | None = field(
        "Test that separates two indistinguishable candidates or, for an unexplained mismatch, the test that tells most about "
        "it; null where there is neither, or where no test within the limits of the rig does so"
    )
    remaining_share: float | None = field(
        "Share of the held-out squared error beyond the noise that remains with all named effects of the worst component: 1 is "
        "all the error that the planned model leaves, 0 none; null where the planned model leaves no error beyond the noise",
        NUMBERS,
        default=None,
    )
    replicated: bool = field(
        "True where two or more held-out recordings each confirm the named effects of the worst component: the held-out gain "
        "of every effect is above zero on each of them",
        default=False,
    )
    rejected: tuple[RejectedEffect, ...] = field(
        "Effects that the evidence selected and that the held-out data did not confirm; they are not named", default=()
    )
    certificate: Certificate | None = field(
        "Measured error rates of diagnoses of this kind of test; null where the kind has no line in the certificate",
        default=None,
    )
    extended_plan: dict[str, Any] | None = field("The plan with the named effects; null where no effect can be added")
