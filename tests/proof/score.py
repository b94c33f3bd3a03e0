"""The score of one case: the verdict compared with the concealed truth."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from rths_engine.diagnosis.schema import NamedEffect, Verdict
from tests.proof import oracle, peer

QUIET = ("consistent", "recalibrate")
NOTHING = ("none", "unknown")
LIKELY = 0.5


def scored(shown: Path, sealed: Path, found: Verdict | None, run: dict[str, Any]) -> dict[str, Any]:
    """The row of a case. `found` is its diagnosis, or None where there is no diagnosis."""
    truth = json.loads((sealed / "truth.json").read_text(encoding="utf-8"))
    row = judged(truth, found)
    known = oracle.judged(shown, sealed, row["heldout"])
    strengths = [one for one in (truth["strength"], known["lambda_rival"]) if one is not None]
    return {
        "case": shown.name,
        "kind": shown.name.split("-")[1],
        "level": truth["level"],
        "about": truth["about"],
        "truth": [named(one) for one in truth["effects"]],
        "outside": truth["outside"],
        "lambda": min(strengths, default=None),
        "lambda_baseline": truth["strength"],
        "exit": run["exit"],
        "said": run["said"],
        "seconds": run["seconds"],
        **known,
        **peer.judged(shown, sealed, truth),
        **row,
    }


def judged(truth: dict[str, Any], found: Verdict | None) -> dict[str, Any]:
    """The scores that need only the truth and the diagnosis; a score is None where there is no diagnosis."""
    verdict, true = found.verdict if found else None, [named(one) for one in truth["effects"]]
    effects = sorted(found.effects if found else (), key=lambda one: -(one.probability or 0.0))
    claimed = [name(one) for one in effects if one.id not in NOTHING]
    ranking = ranked(claimed, found) if found else []
    clean, outside = not true and not truth["outside"], truth["outside"] is not None
    unknown = any(one.id == "unknown" for one in effects) or (verdict == "undetermined" and not claimed)
    where = place(located_at(found)) if found else None
    places = {place(one.partition("/")[0]) for one in true} or {place(truth["about"].get("component") or "specimen:1")}
    claims: list[dict[str, Any]] = [
        {"name": name(one), "probability": one.probability or 0.0, "right": name(one) in true}
        for one in effects
        if one.id not in NOTHING and one.probability is not None
    ]
    sure = any(not one.part_of_it for one in effects if one.id not in NOTHING) or (not unknown and not claimed)
    parameters = [errors(one, effects) for one in truth["effects"] if named(one) in claimed]
    return {
        "verdict": verdict,
        "claimed": claimed,
        "ranked": ranking,
        "probabilities": {name(one): one.probability for one in effects},
        "false_alarm": verdict not in QUIET if clean else None,
        "falsely_named": bool(claimed) if clean else None,
        "located": where in places if not clean else None,
        "named_first": ranking[:1] == true if len(true) == 1 else None,
        "named_top3": true[0] in ranking[:3] if len(true) == 1 else None,
        "honest": verdict in (*QUIET, "undetermined") or true[0] in ranking[:3] if len(true) == 1 else None,
        "two_both": set(true) <= set(claimed) if len(true) == 2 else None,
        "two_one": bool(set(true) & set(claimed)) if len(true) == 2 else None,
        "unknown": unknown and not claimed if outside else None,
        "misnamed": bool(claimed) if outside else None,
        "outside_doubted": not sure if outside else None,
        "misnamed_likely": any(one["probability"] > LIKELY for one in claims) if outside else None,
        "claims": claims,
        "parameters": [row for rows in parameters for row in rows],
        "heldout": {
            "baseline": found.fit.baseline.heldout_nrmse if found else None,
            "extended": found.fit.extended.heldout_nrmse if found else None,
        },
    }


def named(effect: dict[str, Any]) -> str:
    """The effects of a truth."""
    return f"{effect['component']}/{effect['id']}"


def name(effect: NamedEffect) -> str:
    """The effects that a diagnosis names."""
    return f"{effect.component}/{effect.id}"


def ranked(claimed: list[str], found: Verdict) -> list[str]:
    """The effects of a diagnosis in order: the named effects, then the effects of the candidates.

    Without a named effect the list is empty, unless the diagnosis reports indistinguishable candidates.
    """
    order = list(claimed)
    if claimed or found.indistinguishable:
        for candidate in found.candidates:
            order += [one for one in candidate.effects if one not in order]
    return order


def located_at(found: Verdict) -> str | None:
    """The located component: `where`, or else the component with the smallest p-value.

    A computed part whose replay differs comes first, because it has no p-value.
    """
    if found.where:
        return found.where.component
    off = [one for one in found.components if one.mismatch]
    return min(off, key=lambda one: -1.0 if one.p_value is None else one.p_value).component if off else None


def place(component: str | None) -> str | None:
    """The component for the score of locating: all storeys of a structure are one component."""
    return "structure" if component and component.startswith("structure") else component


def errors(effect: dict[str, Any], claimed: list[NamedEffect]) -> list[dict[str, Any]]:
    """For each true parameter with an estimate: its relative error, and whether its 90 % interval contains the truth."""
    told = next(one for one in claimed if name(one) == named(effect))
    rows = []
    for one in told.parameters:
        true = effect["parameters"].get(one.name)
        if true is not None:
            low, high = one.ci90
            error = abs(one.value - true) / max(abs(true), 1e-30)
            rows.append({"name": one.name, "true": true, "told": one.value, "error": error, "covered": low <= true <= high})
    return rows
