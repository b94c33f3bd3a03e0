"""The error rates of diagnoses that `rths prove --certificate` measured, as a verdict cites them."""

from __future__ import annotations

from rths_engine.diagnosis.schema.form import NUMBERS, Form, field


class Rate(Form):
    """A share of cases with its count and its Wilson 95 % interval."""

    value: float | None = field("Share of the cases; null without a case", NUMBERS)
    count: int = field("Number of cases", NUMBERS)
    wilson95: tuple[float, float] | None = field("Wilson 95 % interval of the share, [low, high]; null without a case", NUMBERS)


class Certificate(Form):
    """The line of the certificate that applies to a diagnosis: its kind of test, and sizes of at least 100 in λ."""

    kind: str = field("Kind of the generated cases: specimen, actuator, chain, hybrid or structure")
    false_alarm: Rate = field("Clean recordings with the verdict of a mismatch")
    false_discovery: Rate = field("Named effects that are not part of the truth, among all named effects of this kind of test")
    power: Rate = field("Cases with λ of at least 100 whose concealed effect is named first")
    seed: int = field("Seed of the generated cases", NUMBERS)
    commit: str = field("Commit of the code that was measured; empty where it is not known")
