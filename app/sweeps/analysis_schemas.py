"""JSON forms of what the results of a sweep say: fragility and sensitivity."""

from __future__ import annotations

from pydantic import BaseModel, Field


class ShareOut(BaseModel):
    """Points of one intensity, or of neighbouring intensities: how many, and how many exceed the level."""

    intensity: float
    points: int
    exceeding: int


class FragilityOut(BaseModel):
    """Probability that a measure exceeds a level, against an intensity: P = Phi(ln(x / median) / dispersion)."""

    measure: str
    level: float = Field(description="in the unit of the measure")
    intensity: str
    median: float | None = Field(description="intensity at a probability of 0.5; null where no curve was fitted")
    dispersion: float | None = Field(description="standard deviation of ln x")
    reason: str = Field(description="why no curve was fitted")
    intensities: list[float] = Field(description="of the fitted curve")
    probabilities: list[float]
    empirical: list[ShareOut]
    points: int = Field(description="points with an intensity and an outcome")
    exceeding: int
    tripped: int = Field(description="tripped points, which count as exceeding")
    left_out: int = Field(description="points without intensity or measure")


class BarOut(BaseModel):
    """One input: mean of the measure where the input is low and where it is high."""

    input: str
    label: str
    unit: str
    low: float = Field(description="mean of the measure at the low end of the input")
    high: float
    low_input: float | str = Field(description="the low end of the input")
    high_input: float | str
    correlation: float | None = Field(description="rank correlation (Spearman) of input and measure, -1 to 1")


class SensitivityOut(BaseModel):
    """The dependence of a measure on each input, the strongest first."""

    measure: str
    mean: float | None = Field(description="mean of the measure over the points")
    points: int = Field(description="completed points with a value of the measure")
    left_out: int = Field(description="points with results that did not complete or have no value")
    basis: str = Field(description="which points each bar compares")
    bars: list[BarOut]
