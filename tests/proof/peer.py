"""PySINDy as a peer: sparse regression of the residual of the fitted baseline on one or more terms for each effect.

min |P (r - Theta xi)|^2 with few xi: r residual of the baseline refitted to the noisy output, P takes out what the baseline's
own numbers absorb, Theta the terms below. Greedy selection (FROLS) by BIC; the effect of the term that explains most is first.
The peer also gets the noise-free displacement, the right component and the true colour of the noise.
Source: Kaptanoglu et al. (2022), J. Open Source Softw. 7, 3994. Backlash and dropouts have no term.
"""

from __future__ import annotations

import warnings
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from tests.proof.models import Case, SpecimenModel, model
from tests.proof.oracle import Fit, Oracle

MOST_TERMS = 4
WORTH = 6.0  # of BIC: strong evidence


def installed() -> bool:
    return find_spec("pysindy") is not None


def named(shown: Path, sealed: Path) -> str | None:
    """The effect that the peer names first; `none` where no term is significant, None where the peer does not apply."""
    case = Case.opened(shown, sealed)
    if not installed() or len(case.truth["effects"]) != 1:
        return None
    if case.truth["effects"][0]["component"].startswith("actuator") or not isinstance(model(case), SpecimenModel):
        return None
    oracle = Oracle(case)
    fitted = Fit(oracle, oracle.model.base, oracle.noisy[0])
    residual = oracle.white(oracle.model.out(fitted.fitted, 0), oracle.noisy[0])
    terms = library(oracle, oracle.model.out(fitted.fitted, 0)[0])
    rows = np.column_stack([oracle.white([0.0 * one], [one]) for one in terms.values()])
    absorbed = np.linalg.qr(fitted.jacobian[: len(residual)])[0]
    rows, residual = (one - absorbed @ (absorbed.T @ one) for one in (rows, residual))
    return chosen(rows, residual, list(terms))


def library(oracle: Oracle, force: Array) -> dict[str, Array]:
    """The terms, by the effect that each term represents; several terms of one effect are numbered."""
    quiet, dt = oracle.case.quiet[0], oracle.case.dt
    x, current = quiet["x_meas.1"], np.abs(quiet.get("current.1", np.ones(len(force))))
    v = np.gradient(x, dt)
    a, time = np.gradient(v, dt), np.arange(len(x)) * dt
    u, w = x / np.max(np.abs(x)), v / np.max(np.abs(v))
    energy = np.cumsum(force * v) * dt
    worn = -np.expm1(-np.maximum(energy, 0.0) / (0.3 * max(float(energy.max()), 1e-12)))
    slides, beyond = np.tanh(w / 0.01), np.maximum(np.abs(u) - 0.6, 0.0)
    terms = {
        "coulomb_friction": slides,
        "stribeck_friction": slides * np.exp(-((w / 0.08) ** 2)),
        "viscous_heating": force * energy,
        "series_compliance": np.gradient(force, dt) * np.sign(v) * w,
        "parallel_stiffness": u,
        "cubic_stiffness": u**3,
        "added_inertia": a,
        "asymmetry": np.abs(force),
        "velocity_exponent": force * np.log(np.hypot(w, 0.025)),
        "bouc_wen_hysteresis": stop(u, 0.1),
        "bouc_wen_hysteresis 2": stop(u, 0.03),
        "pinching": force * np.exp(-((u / 0.2) ** 2)),
        "strength_degradation": force * worn,
        "peak_degradation": force * np.maximum.accumulate(np.abs(u)),
        "stiffness_degradation": u * worn,
        "self_centring": np.clip(u / 0.12, -1.0, 1.0),
        "pendulum_friction": u + slides * (1.0 - 0.5 * np.exp(-np.abs(w) / 0.15)),
        "gap_contact": np.sign(u) * beyond * (1.0 + beyond),
        "asymmetric_viscosity": np.abs(w),
        "stick_slip": stop(u, 0.01) / 0.01 - stop(u, 0.1) / 0.1,
        "offset": np.ones(len(x)),
        "drift": time,
        "time_skew": np.gradient(force, dt),
        "clipping": force * (np.abs(force) > 0.9 * np.max(np.abs(force))),
        "|v| v": np.abs(w) * w,
    }
    terms |= {f"strength_drop {k}": force * (time > k * time[-1] / 8) for k in range(2, 8)}
    if np.ptp(current) > 0:
        terms["current_lag"] = force * np.gradient(current, dt)
        terms["strength_against_current"] = force * current
        terms["residual_field"] = force * stop(current, 0.3 * float(np.max(current)))
    if "temperature.1" in quiet:
        terms["strength_against_temperature"] = force * (quiet["temperature.1"] - np.mean(quiet["temperature.1"]))
    return terms


def stop(x: Array, reach: float) -> Array:
    """The stop operator: an elastic-plastic element that yields after `reach`."""
    found, at = np.empty(len(x)), 0.0
    for place, one in enumerate(np.diff(x, prepend=x[0]).tolist()):
        at = min(max(at + one, -reach), reach)
        found[place] = at
    return found


def chosen(rows: Array, residual: Array, names: list[str]) -> str:
    from pysindy.optimizers import FROLS

    sizes = np.linalg.norm(rows, axis=0)
    kept = [place for place, size in enumerate(sizes) if size > 0]
    scaled, best, order = rows[:, kept] / sizes[kept], float(residual @ residual), []
    for count in range(1, MOST_TERMS + 1):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = FROLS(max_iter=count, kappa=0.0).fit(scaled, residual[:, None]).coef_[0]
        used = np.flatnonzero(found)
        solved = np.linalg.lstsq(scaled[:, used], residual, rcond=None)[0]
        left = float(np.sum((residual - scaled[:, used] @ solved) ** 2)) + len(used) * np.log(len(residual))
        if left > best - WORTH:
            break
        best, order = left, [names[kept[place]] for place in used[np.argsort(-np.abs(solved))]]
    return order[0].partition(" ")[0] if order else "none"


def judged(shown: Path, sealed: Path, truth: dict[str, Any]) -> dict[str, Any]:
    said = named(shown, sealed)
    return {"peer_named": said, "peer_named_first": None if said is None else said == truth["effects"][0]["id"]}
