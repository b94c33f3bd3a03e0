"""What no named effect explains: its size, its place, its formula, and how much of it held-out data confirm."""

from __future__ import annotations

from rths_engine.diagnosis.schema.form import AS_STATED, NUMBERS, Form, field


class Scale(Form):
    """The value that divides a symbol of a formula."""

    symbol: str = field("Symbol: x displacement, v velocity, a acceleration, f force, E dissipated energy, or t time")
    value: float = field("The largest value in the first recording", AS_STATED)
    unit: str = field("SI unit of the value")


class LawTerm(Form):
    """A term of the formula: its coefficient times a function of scaled symbols."""

    coefficient: float = field("Coefficient of the term", AS_STATED)
    unit: str = field("SI unit of the coefficient")
    formula: str = field("Function of the scaled symbols, such as x^2 v; sgn(v) is smooth near v = 0")
    words: str = field("The term in words")
    place: str = field("Storey of a structure, such as storey 2; empty for other components")
    scales: tuple[Scale, ...] = field("The scales of the symbols in the formula")


class Unexplained(Form):
    """The residual that the extended model leaves beyond the noise; of the planned model where no effect is named."""

    fraction: float | None = field(
        "RMS of the residual beyond the noise over the RMS of the recorded signal about its mean; null where it is not finite",
        NUMBERS,
    )
    formula: str | None = field(
        "Formula of the unexplained residual, recorded minus simulated; null where held-out data confirm no term. x, v, a, f, "
        "E and t are divided by the values that the formula states"
    )
    words: str = field("The unexplained residual in words")
    size: float | None = field(
        "RMS of the unexplained residual beyond the noise; for a structure, RMS of the unexplained force in the storey where "
        "it is largest; null where nothing is left to describe, or held-out data confirm no such force",
        AS_STATED,
        default=None,
    )
    unit: str | None = field("SI unit of the size: N for a force, m for the displacement of an actuator", default=None)
    formula_share: float | None = field(
        "Share of the held-out squared error beyond the noise that the formula explains; null without a formula",
        NUMBERS,
        default=None,
    )
    state_share: float | None = field(
        "Share of the held-out squared error beyond the noise that the mean residual in each cell of displacement and velocity "
        "explains; the rest changes within a cell, or depends on the history of the motion or on other quantities; below 0 "
        "where it explains nothing; null where nothing is left to describe",
        NUMBERS,
        default=None,
    )
    state: str | None = field(
        "Where the unexplained residual is largest and how it depends on displacement and velocity, in words; null where "
        "nothing is left to describe",
        default=None,
    )
    times_s: tuple[tuple[float, float], ...] = field(
        "Time spans, each [begin, end], in which the unexplained residual exceeds three standard deviations of the noise",
        "s",
        default=(),
    )
    bands_hz: tuple[tuple[float, float], ...] = field(
        "Frequency bands, each [low, high], that hold the middle 90 % of the power of the unexplained residual",
        "Hz",
        default=(),
    )
    terms: tuple[LawTerm, ...] = field("The terms of the formula", default=())
