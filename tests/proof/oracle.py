"""The oracle: it knows the right structure, the noise-free inputs and the spectrum of the noise (S of lambda).

lambda_rival = min over rivals r of chi^2_r - chi^2_true, both at their best fit to the noise-free output, in the noise's units.
It names an effect first where chi^2 + k ln N of the right structure on the noisy output is below that of the baseline and of
every rival: the effect's relatives in the library, on the same storey.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from tests.proof.generator.noise import TRUSTED, Colour
from tests.proof.models import Case, model

EVALUATIONS = 15
WORTHWHILE = 0.02  # of the baseline's error: a gain below is no gain to share in


class Fit:
    """The best fit of a model to an output; by default, the noise-free output."""

    def __init__(self, of: Oracle, parts: tuple[Any, ...], output: list[Array] | None = None) -> None:
        self.of, self.parts, self.free = of, parts, _numbers(parts, len(of.model.base))
        start = np.zeros(len(self.free))
        held = np.array(of.model.tolerances[: sum(place < len(of.model.base) for place, *_ in self.free)])

        def misfit(z: Array) -> Array:
            return np.concatenate([of.white(of.model.out(self.at(z), 0), output or of.quiet[0]), z[: len(held)] / held])

        solved = least_squares(misfit, start, diff_step=1e-3, x_scale="jac", max_nfev=EVALUATIONS, ftol=1e-4)
        self.fitted, self.squared, self.jacobian = self.at(solved.x), float(solved.fun @ solved.fun), solved.jac

    def at(self, z: Array) -> tuple[Any, ...]:
        changes: list[dict[str, float]] = [{} for _ in self.parts]
        for (place, name, value, scale), one in zip(self.free, z.tolist(), strict=True):
            low = place < len(self.of.model.base) and value > 0
            changes[place][name] = value * float(np.exp(np.clip(one, -3, 3))) if low else value + scale * one
        return tuple(_changed(part, change) for part, change in zip(self.parts, changes, strict=True))

    @property
    def evidence(self) -> float:
        """chi^2 + k ln N on the noisy output."""
        white = self.of.white(self.of.model.out(self.fitted, 0), self.of.noisy[0])
        return float(white @ white) + len(self.free) * float(np.log(len(white)))

    def error(self) -> float:
        """NRMSE on the held-out recording, up to TRUSTED."""
        off, size = 0.0, 0.0
        for ours, real in zip(self.of.model.out(self.fitted, 1), self.of.noisy[1], strict=True):
            off += float(np.sum(self.of.below(real - ours) ** 2) / np.var(self.of.below(real)))
            size += len(real)
        return float(np.sqrt(off / size))


class Oracle:
    def __init__(self, case: Case) -> None:
        found = model(case)
        assert found is not None
        self.case, self.model = case, found
        noise = Colour(**case.truth["noise"])
        self.quiet = [[one[key] for key in found.keys] for one in case.quiet]
        self.noisy = [[one[key] for key in found.keys] for one in case.shown]
        first = float(np.std(self.quiet[0][0]))
        scales = [float(np.std(one)) / first for one in self.quiet[0]]
        self.noises = [Colour(noise.sigma * scale, noise.step, noise.corner, noise.share, noise.taken) for scale in scales]

    def white(self, ours: list[Array], real: list[Array]) -> Array:
        rows = [noise.whitened(true - one) for noise, one, true in zip(self.noises, ours, real, strict=True)]
        white: Array = np.nan_to_num(np.concatenate(rows), nan=1e6, posinf=1e6, neginf=-1e6)
        return white

    def below(self, signal: Array) -> Array:
        spectrum = np.fft.rfft(signal)
        spectrum[np.fft.rfftfreq(len(signal), self.case.dt) > TRUSTED] = 0.0
        return np.asarray(np.fft.irfft(spectrum, len(signal)))

    def true(self) -> tuple[Effect, ...]:
        return tuple(self.started(one) for one in self.case.truth["effects"])

    def started(self, told: dict[str, Any]) -> Effect:
        """The effect of the library with its true parameters; parameters without a true value keep their starting values."""
        kind = next(one for one in self.model.rivals if one.model_fields["kind"].default == told["id"])
        guess = self.guess(kind, told["component"])
        own = {name: value for name, value in told["parameters"].items() if name in kind.model_fields}
        return guess.model_copy(update=own)

    def guess(self, kind: type[Effect], component: str) -> Effect:
        """The starting values of an effect whose output is nearest to the true output."""
        place = component.partition(":")[2]
        seen = self.model.seen(int(place) if component.startswith("structure:") else 1)
        guesses: list[Effect] = list(physics.SEARCHES[kind].guesses(seen))
        if len(guesses) == 1:
            return guesses[0]
        return min(
            guesses, key=lambda one: float(np.sum(self.white(self.model.out((*self.model.base, one), 0), self.quiet[0]) ** 2))
        )

    def rivals(self) -> list[Effect]:
        (told,) = self.case.truth["effects"]
        names = physics.SEARCHES[type(self.started(told))].relatives
        kinds = [one for one in self.model.rivals if one.model_fields["kind"].default in names]
        return [self.guess(kind, told["component"]) for kind in kinds]


def judged(shown: Path, sealed: Path, heldout: dict[str, float | None]) -> dict[str, Any]:
    """`lambda_rival`, `oracle_named_first` and `gain_share`; each is None where the oracle cannot compute it."""
    nothing: dict[str, Any] = {"lambda_rival": None, "oracle_named_first": None, "gain_share": None}
    case = Case.opened(shown, sealed)
    if not case.truth["effects"] or model(case) is None:
        return nothing
    oracle = Oracle(case)
    base = oracle.model.base
    plain, right = Fit(oracle, base), Fit(oracle, (*base, *oracle.true()))
    share = gain_share(plain.error(), right.error(), heldout)
    if len(case.truth["effects"]) > 1:
        return {**nothing, "gain_share": share}
    rivals = [plain, *(Fit(oracle, (*base, one)) for one in oracle.rivals())]
    return {
        "lambda_rival": max(0.0, min(one.squared for one in rivals) - right.squared),
        "oracle_named_first": right.evidence < min(one.evidence for one in rivals),
        "gain_share": share,
    }


def gain_share(before: float, after: float, told: dict[str, float | None]) -> float | None:
    """The gain on the held-out recording over the oracle's gain; None where the oracle gains less than WORTHWHILE."""
    base, extended = told["baseline"], told["extended"]
    if base is None or extended is None or before - after < WORTHWHILE * before:
        return None
    return (base - extended) / (before - after)


def _numbers(parts: tuple[Part, ...], base: int) -> list[tuple[int, str, float, float]]:
    """The free parameters: index of the part, name, value, and scale of a change."""
    found = []
    for place, part in enumerate(parts):
        held = physics.SEARCHES[type(part)].held if isinstance(part, Effect) else ()
        for name, field in type(part).model_fields.items():
            if field.annotation is float and name not in (*held, "velocity_limit", "force_limit"):
                value = float(getattr(part, name))
                found.append((place, name, value, abs(value) or (1.0 if place < base else 1e-3)))
            elif name == "velocity_limit" and isinstance(part, Effect):
                found.append((place, name, float(getattr(part, name)), abs(float(getattr(part, name)))))
    return found


def _changed(part: Any, change: dict[str, float]) -> Any:
    """The part with changed parameters, within the bounds of an effect; a planned parameter that is zero stays zero."""
    if isinstance(part, Effect) and not change.keys() - type(part).model_fields.keys():
        sized = physics.SEARCHES[type(part)].sized(**{name: float(value) for name, value in change.items()})
        return part.model_copy(update={name: getattr(sized, name) for name in change})
    return part.model_copy(update={name: value for name, value in change.items() if getattr(part, name)})
