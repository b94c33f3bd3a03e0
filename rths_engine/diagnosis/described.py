"""The words for what no named effect explains: size with its unit, place, dependence on the motion, and formula."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from rths_engine.diagnosis import schema
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.diagnosis.surface import Surface
from rths_engine.diagnosis.unknown import Term
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.roles import SHOWN, dimension, to_si

# chosen; see docs/decisions/0023
MOSTLY = 0.65  # share of the power of a surface that makes it odd or even
CLEARLY = 2.5  # ratio of mean powers
REAL = 4.0  # power of a surface in units of its standard errors: below it, the dependence on the state is noise
SPANS = 3  # time spans in a sentence
NO_DEPENDENCE = "It shows no clear dependence on displacement and velocity."
SYMBOLS = {"x": "m", "v": "m/s", "a": "m/s^2", "f": "N", "E": "J", "t": "s"}
SHOWN_AS = {"J": ("kJ", 1e3), "s": ("s", 1.0), "m/s^2": ("m/s²", 1.0)}


def sentence(left: Remaining, name: str) -> str:
    """Size, time, frequency, dependence on the motion, and formula of what remains, in sentences."""
    what = f"unexplained {_noun(left)}"
    at = f" in {left.at}" if left.at else ""
    size = (
        f"The {what} of the {name}{at} is {shown(left.size, left.unit)} RMS" if left.located else f"The {name} has a residual"
    )
    times = [f"{start:.1f} to {end:.1f} s" for start, end in left.place.times]
    more = f" and {len(times) - SPANS} more spans" if len(times) > SPANS else ""
    when = f", from {', '.join(times[:SPANS])}{more}" if times else ""
    bands = ", ".join(f"{low:.3g} to {high:.3g} Hz" for low, high in left.place.bands)
    often = f", at {bands}" if bands else ""
    return " ".join([f"{size}{when}{often}.", state(left), *formula_words(left)])


def state(left: Remaining) -> str:
    """How the unexplained residual depends on displacement and velocity, in sentences."""
    if not left.located:
        return "Held-out data confirm no force that depends on the drift and the drift velocity of a storey."
    surface = left.largest
    found = [_peak(surface, left.unit), _traits(surface, left.unit)] if _clear(surface) else [NO_DEPENDENCE]
    share = left.state_share
    if share is not None:
        said = f"Its mean over cells of displacement and velocity explains {100 * max(0.0, share):.0f} % of it on held-out data"
        rest = "; the rest changes within a cell, or depends on the history of the motion, on time or on what is not recorded"
        found.append(f"{said}{rest if share < MOSTLY else ''}.")
    return " ".join(one for one in found if one)


def formula(left: Remaining) -> str | None:
    """The formula with shown units, and the values that divide its symbols."""
    if left.law is None:
        return None
    parts = [f"{_signed(term, left.unit)} {term.formula}{f' ({term.place})' if term.place else ''}" for term in left.law.terms]
    text = " ".join(parts).removeprefix("+")
    scales = {(term.place, scale.symbol): scale for term in left.law.terms for scale in _scales(term)}
    named = [f"{symbol}{f' of {at}' if at else ''} in {shown(one.value, one.unit)}" for (at, symbol), one in scales.items()]
    return f"{text}, with {', '.join(named)}" if named else text


def formula_words(left: Remaining) -> list[str]:
    """The sentences on the formula; none where held-out data confirm no term."""
    if left.law is None:
        return ["Held-out data confirm no formula."]
    share = f"The formula explains {100 * left.law.held_out_share:.0f} % of it on held-out data"
    return [f"{share}. Its terms: {left.law.words}."]


def law_terms(left: Remaining) -> tuple[schema.LawTerm, ...]:
    """The terms of the formula in the form of a verdict."""
    return tuple(
        schema.LawTerm(
            coefficient=term.coefficient,
            unit=left.unit,
            formula=term.formula,
            words=term.words,
            place=term.place,
            scales=tuple(_scales(term)),
        )
        for term in (left.law.terms if left.law else ())
    )


def shown(value: float, unit: str) -> str:
    """A value with three digits in the unit that people read."""
    name, factor = SHOWN_AS.get(unit) or (SHOWN[dimension(unit)], to_si(SHOWN[dimension(unit)])[0])
    return f"{value / factor:.3g} {name}"


def _noun(left: Remaining) -> str:
    return "displacement" if left.unit == "m" else "storey force" if left.at else "force"


def _signed(term: Term, unit: str) -> str:
    return f"{'-' if term.coefficient < 0 else '+'}{shown(abs(term.coefficient), unit)}"


def _scales(term: Term) -> Iterator[schema.Scale]:
    """The scales of the symbols of a formula; periodic functions state their own period."""
    if term.sizes is None:
        return
    used = set(re.findall(r"[A-Za-z]+", re.sub(r"(sin|cos)\([^)]*\)|sgn\(v\)", "", term.formula)))
    values = dict(zip("xvafEt", term.sizes, strict=True))
    for symbol, unit in SYMBOLS.items():
        if symbol in used:
            yield schema.Scale(symbol=symbol, value=values[symbol], unit=unit)


def _clear(surface: Surface) -> bool:
    """True where the surface has clearly more power than its standard errors give."""
    known = np.isfinite(surface.error)
    power, noise = (float(np.sum(surface.samples[known] * one[known] ** 2)) for one in (surface.mean, surface.error))
    return power > REAL * noise


def _peak(surface: Surface, unit: str) -> str:
    """The cell with the largest clear mean."""
    clear = np.isfinite(surface.error) & (np.abs(surface.mean) > 2 * surface.error)
    if not clear.any():
        return ""
    row, column = np.unravel_index(int(np.argmax(np.where(clear, np.abs(surface.mean), 0.0))), surface.mean.shape)
    x, v = (_centre(edges, int(at)) for edges, at in ((surface.x.values, row), (surface.v.values, column)))
    value, error = (float(one[row, column]) for one in (surface.mean, surface.error))
    return f"Its mean is largest, {shown(value, unit)} ± {shown(error, unit)}, near {shown(x, 'm')} and {shown(v, 'm/s')}."


def _centre(edges: Array, at: int) -> float:
    """The middle of a cell; exactly 0 for the cell at rest."""
    return 0.0 if 2 * at + 2 == len(edges) else float(0.5 * (edges[at] + edges[at + 1]))


def _traits(surface: Surface, unit: str) -> str:
    """Parity and growth of the surface in words."""
    found = [*_parity(surface, unit), *_growth(surface)]
    return f"It is {' and '.join(found)}." if found else ""


def _parity(surface: Surface, unit: str) -> list[str]:
    mean, weight = np.nan_to_num(surface.mean), np.where(surface.visited, surface.samples, 0)
    odd_v, even_v = _split(mean, weight, 1)
    centre = 0.5 * (surface.v.values[1:] + surface.v.values[:-1])
    if odd_v > MOSTLY:
        along = float(np.sum(weight * mean * centre[None, :])) > 0
        if unit == "m":
            return [f"odd in velocity (the recording {'leads' if along else 'lags'} the model)"]
        return [f"odd in velocity (the recording dissipates {'more' if along else 'less'} energy than the model)"]
    if even_v > MOSTLY:
        odd_x, even_x = _split(mean, weight, 0)
        if odd_x > MOSTLY:
            return ["odd in displacement and even in velocity (elastic)"]
        return ["even in displacement and in velocity (an asymmetry)"] if even_x > MOSTLY else ["even in velocity"]
    return []


def _split(mean: Array, weight: Array, axis: int) -> tuple[float, float]:
    """Shares of the power of the odd and of the even part along an axis, over cells whose mirror has samples."""
    pair = np.minimum(weight, np.flip(weight, axis))
    other = np.flip(mean, axis)
    odd, even = (float(np.sum(pair * (0.5 * one) ** 2)) for one in (mean - other, mean + other))
    return odd / max(odd + even, 1e-300), even / max(odd + even, 1e-300)


def _growth(surface: Surface) -> list[str]:
    mean, weight = np.nan_to_num(surface.mean), np.where(surface.visited, surface.samples, 0).astype(float)
    found = []
    for axis, label in ((0, "displacement"), (1, "velocity")):
        size = np.abs(np.arange(mean.shape[axis]) - (mean.shape[axis] - 1) / 2) / ((mean.shape[axis] - 1) / 2)
        rows, counts = np.sum(weight * mean**2, axis=1 - axis), np.sum(weight, axis=1 - axis)
        low, high = (float(rows[at].sum() / max(counts[at].sum(), 1.0)) for at in (size < 0.4, size > 0.6))
        if high > CLEARLY * low:
            found.append(f"larger at large {label}")
        elif low > CLEARLY * high:
            found.append(f"larger at small {label}")
    return found
