"""The definition of a sweep, `rths-sweep/1`: the plan, the fields that vary, and the method that makes points of them."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

# chosen; see docs/decisions/0023
MOST_POINTS = 100_000
MOST_FIELDS = 20
MOST_LEVELS = 10_000

SAMPLED = ("latin_hypercube", "monte_carlo")
METHODS = {
    "grid": "Grid: every combination of the values",
    "list": "List: the first value of each field, then the second, and so on",
    "one_at_a_time": "One at a time: the plan itself, then each value of each field alone",
    "latin_hypercube": "Latin hypercube",
    "monte_carlo": "Monte Carlo",
}

Number = float | str
"""A number, or text with a unit such as `36007 kN/m`."""


class Form(BaseModel):
    """Base of the parts of a definition: an unknown key is an error, and numbers are finite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True, validate_by_name=True, validate_by_alias=True)


class Range(Form):
    """`count` values from `from` to `to`, both included, at equal differences (linear) or at equal ratios (log)."""

    from_: Number = Field(alias="from", title="From")
    to: Number = Field(title="To")
    count: int = Field(ge=2, le=MOST_LEVELS, title="Number of values")
    spacing: Literal["linear", "log"] = Field("linear", title="Spacing")


class Uniform(Form):
    """Every value from `lower` to `upper` is equally probable."""

    kind: Literal["uniform"] = "uniform"
    lower: Number = Field(title="Lower end")
    upper: Number = Field(title="Upper end")


class Normal(Form):
    """Normal distribution, truncated at `lower` and `upper`. A missing end is the bound of the field."""

    kind: Literal["normal"] = "normal"
    mean: Number = Field(title="Mean before truncation")
    sd: Number = Field(title="Standard deviation before truncation")
    lower: Number | None = Field(None, title="Lower end")
    upper: Number | None = Field(None, title="Upper end")


class Lognormal(Form):
    """Lognormal distribution, truncated at `lower` and `upper`. `sigma_ln` is the standard deviation of ln x (dispersion)."""

    kind: Literal["lognormal"] = "lognormal"
    median: Number = Field(title="Median before truncation")
    sigma_ln: float = Field(gt=0, le=5, title="Standard deviation of ln x")
    lower: Number | None = Field(None, title="Lower end")
    upper: Number | None = Field(None, title="Upper end")


Distribution = Annotated[Uniform | Normal | Lognormal, Field(discriminator="kind")]


class Values(Form):
    """The values of a field: a list, a range or a distribution; exactly one of the three.

    `unit` is the unit of numbers without a unit; by default SI.
    """

    unit: str | None = Field(None, max_length=40, title="Unit of plain numbers")
    values: tuple[Any, ...] | None = Field(None, min_length=1, max_length=MOST_LEVELS, title="List")
    range: Range | None = Field(None, title="Range")
    distribution: Distribution | None = Field(None, title="Distribution")


class Varied(Values):
    """A field of the plan that varies, or several fields that get the same value (`path` is a list then).

    `path` is dotted, `structure.damping_ratio`; an index counts from 0, `*` stands for every item: `stations.*.noise.force`.
    With `change: multiply` the values are factors on the plan's value of each field.
    """

    path: str | Annotated[tuple[str, ...], Field(min_length=1, max_length=MOST_FIELDS)] = Field(title="Field")
    change: Literal["set", "multiply"] = Field("set", title="Change")

    @property
    def paths(self) -> tuple[str, ...]:
        return (self.path,) if isinstance(self.path, str) else self.path


class Scales(Values):
    """Scales of the ground motion: a factor, the peak ground acceleration, or the spectral acceleration at T1."""

    kind: Literal["factor", "pga", "sa_t1"] = Field("factor", title="Kind of scale")


class Definition(Form):
    """A sweep: `plan` with its varied `fields`, times `records` (names of ground motions) and `scales` of each record.

    `samples` and `seed` belong to the methods latin_hypercube and monte_carlo, in which every field has a distribution.
    """

    schema_: Literal["rths-sweep/1"] = Field("rths-sweep/1", alias="schema", title="Format of the sweep")
    name: str = Field("Untitled sweep", min_length=1, max_length=200, title="Name")
    notes: str = Field("", max_length=10_000, title="Notes")
    plan: dict[str, Any] | str = Field(title="Plan", description="a plan, or the name of a template")
    method: Literal["grid", "list", "one_at_a_time", "latin_hypercube", "monte_carlo"] = Field(
        "grid", title="Method", json_schema_extra={"titles": {**METHODS}}
    )
    fields: tuple[Varied, ...] = Field((), max_length=MOST_FIELDS, title="Varied fields")
    samples: int | None = Field(None, ge=1, le=MOST_POINTS, title="Samples")
    seed: int = Field(0, ge=0, le=2**63 - 1, title="Seed of the samples")
    records: tuple[str, ...] = Field((), max_length=MOST_LEVELS, title="Records of the library")
    scales: Scales | None = Field(None, title="Scales of the records")

    @property
    def sampled(self) -> bool:
        return self.method in SAMPLED

    def as_dict(self) -> dict[str, Any]:
        return self.model_dump(mode="json", by_alias=True, exclude_none=True)
