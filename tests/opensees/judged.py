"""The score of a verdict on a material law: named, near, honestly unknown, or wrong."""

from __future__ import annotations

from typing import Any

from rths_engine.diagnosis.schema import NamedEffect, Verdict
from tests.opensees.laws import Law
from tests.proof.score import NOTHING, QUIET, name

SURE = 0.5  # a wrong name above this probability is a wrong verdict
REACHED = ("named", "near", "unknown", "part of it", "agrees")


def judged(kind: str, law: Law, found: Verdict | None) -> dict[str, Any]:
    """The row of a case: its outcome, its claims and its held-out errors. `found` is None where there is no verdict."""
    if found is None:
        return {"outcome": "no verdict", "claims": [], "heldout": [None, None], "remaining": None}
    claims = sorted((one for one in found.effects if one.id not in NOTHING), key=lambda one: -(one.probability or 0.0))
    return {
        "outcome": outcome(kind, law, found, claims),
        "claims": [{"name": name(one), "probability": one.probability, "part_of_it": one.part_of_it} for one in claims],
        "heldout": [found.fit.baseline.heldout_nrmse, found.fit.extended.heldout_nrmse],
        "remaining": found.remaining_share,
    }


def outcome(kind: str, law: Law, found: Verdict, claims: list[NamedEffect]) -> str:
    """One word for a verdict; the first that applies.

    `wrong`: a name that is neither right nor near, above SURE, even as a part of the mismatch.
    `agrees`, `false alarm`: on the control.
    `named`, `near`: at least one such name.
    `unknown`: the verdict says so. `part of it`: every name only as a part. `missed`: none of these.
    """
    right, near = (
        [one for one in claims if one.component.partition(":")[0] == kind and one.id in ids] for ids in (law.right, law.near)
    )
    if any(one not in [*right, *near] and (one.probability or 0.0) > SURE for one in claims):
        return "wrong"
    if law.control:
        return "agrees" if found.verdict in QUIET and not claims else "false alarm"
    if right or near:
        return "named" if right else "near"
    if any(one.id == "unknown" for one in found.effects) or (found.verdict == "undetermined" and not claims):
        return "unknown"
    return "part of it" if claims and all(one.part_of_it for one in claims) else "missed"
