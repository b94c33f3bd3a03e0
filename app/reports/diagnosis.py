"""The report of a diagnosis, and what its page shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from app.reports.diagnosis_figures import details, over_time
from app.reports.diagnosis_tables import Tables, tables
from app.reports.document import (
    Block,
    Document,
    Facts,
    Figures,
    Head,
    Heading,
    Letterhead,
    Section,
    Signatures,
    Table,
    Text,
    Verdict,
)
from app.reports.made import made
from rths_engine.diagnosis import schema
from rths_engine.diagnosis.schema import Pictures

Pairs = list[tuple[str, str]]
TONES = {"consistent": "good", "mismatch": "bad", "configuration_error": "bad"}
ALONE = (
    "Each component is simulated alone; its inputs are the recorded signals. An error is the RMS of the residual over the RMS "
    "of the measured signal about its mean. The p-value is the probability of a residual at least this far from noise if the "
    "model is right. A computed component (–) has no noise and no p-value: its simulation must agree with the recording to "
    "rounding."
)
SORTED = (
    "The candidates are sorted by probability. ΔBIC is the rise of the Bayesian information criterion on fitted data above "
    "that of the best candidate."
)
HELD_OUT = (
    "The noise floor is {floor} %. Three of ten blocks of the recording are held out: they are never fitted. If held-out "
    "recordings were given, the held-out error is the error on those recordings."
)


def shown(verdict: schema.Verdict, pictures: Pictures, plan: Mapping[str, Any]) -> dict[str, Any]:
    """The tables and plots that the template of the page shows; `plan` is the plan in JSON form."""
    return {"told": tables(verdict, plan), "over_time": over_time(pictures), "details": details(pictures)}


def document(
    title: str,
    facts: Pairs,
    verdict: schema.Verdict,
    pictures: Pictures,
    plan: Mapping[str, Any],
    letterhead: Letterhead | None = None,
    signatures: Sequence[str] = (),
) -> Document:
    """The report of a diagnosis; `plan` is the plan in JSON form."""
    told = tables(verdict, plan)
    sections = [
        Section("Claims, their proof and the doubt", _claims(told)),
        Section("Where recording and simulation differ", _where(told, pictures)),
        Section("Left-out physics", _what(told)),
        Section("Proof on held-out data", _proof(told)),
        Section("Unexplained residual", [Facts(told.unexplained, long=True)]),
        Section("Next test", [Text([told.next_test])]),
        *(Section(one.title, [Figures(one.panels)]) for one in details(pictures)),
    ]
    if signatures:
        sections.append(Section("Signatures", [Signatures(signatures)], together=True))
    return Document(
        kind="Diagnosis: comparison of a recording with its plan",
        title=title,
        verdict=Verdict(told.sentence, tone=TONES.get(told.kind, "")),
        facts=facts,
        sections=sections,
        subject=f"Diagnosis of {dict(facts).get('Recording', title)}",
        made=made(),
        further=told.further,
        letterhead=letterhead or Letterhead(),
    )


def _claims(told: Tables) -> list[Block]:
    blocks: list[Block] = []
    if told.remaining is not None:
        remains = (
            f"Unexplained: {100 * told.remaining:.0f} % of the held-out error beyond the noise remains after all named effects."
        )
        blocks.append(Text([remains]))
    for claim in told.claims:
        blocks.append(Heading(claim.title))
        if claim.sentence != told.sentence:
            blocks.append(Text([claim.sentence]))
        blocks.append(Facts(claim.facts, long=True))
    if not told.claims:
        blocks.append(Text(["No effect is named."]))
    return [*blocks, Heading("Doubt"), Facts(told.doubt, long=True)] if told.doubt else blocks


def _where(told: Tables, pictures: Pictures) -> list[Block]:
    heads = [Head("Component", share=2), Head("Verdict"), *_numbers("Error of the planned model, %", "Noise, %", "p-value")]
    blocks: list[Block] = [Facts(told.where, long=True)] if told.where else []
    return [*blocks, Figures([over_time(pictures)]), Table("Components", heads, told.components), Text([ALONE], "note")]


def _what(told: Tables) -> list[Block]:
    blocks: list[Block] = []
    if told.parameters:
        heads = [Head("Effect", share=2), Head("Parameter", share=2), *_numbers("Value", "90 % interval from", "to", "Unit")]
        blocks.append(Table("Parameters of the left-out physics", heads, told.parameters))
    heads = [Head("Candidate", share=3), *_numbers("Probability", "Held-out error, %", "ΔBIC")]
    blocks.append(Table("Ranking of the candidates", heads, [[name, *cells] for name, _, cells in told.ranking]))
    alike = [f"This recording cannot distinguish these candidates: {group}." for group in told.alike]
    return [*blocks, Text([SORTED, *alike], "note")]


def _proof(told: Tables) -> list[Block]:
    heads = [Head("Model", share=2), *_numbers("Error on fitted data, %", "Error on held-out data, %")]
    table = Table("Error of the planned and of the extended model", heads, told.fit)
    return [table, Text([HELD_OUT.format(floor=told.noise_floor)], "note")]


def _numbers(*labels: str) -> list[Head]:
    return [Head(one, number=True) for one in labels]
