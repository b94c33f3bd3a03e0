"""The claims of a verdict, each with its own proof, and the doubt that remains."""

from __future__ import annotations

from dataclasses import dataclass

from app.reports.diagnosis_names import Names, capital
from app.reports.digits import chance, percent, short, words
from rths_engine.diagnosis.schema import Certificate, NamedEffect, Rate, RejectedEffect, Verdict

PART = "Part of it: "  # begins the sentence of such an effect; on a page, its title
NO_CLAIMS = ("unknown", "configuration_error")  # version 0.1.0 stored a probability for these too
Facts = list[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Claim:
    """A named effect on a page: its sentence, its probability in words and as a number, and the facts of its proof."""

    title: str
    sentence: str
    words: str
    probability: float
    facts: Facts


def claims(verdict: Verdict, names: Names) -> list[Claim]:
    """The named effects that have a probability, in the order of the verdict."""
    return [_claim(one, verdict, names) for one in verdict.effects if one.probability is not None and one.id not in NO_CLAIMS]


def doubt(verdict: Verdict, names: Names) -> Facts:
    """What speaks against the verdict beside the remaining error: missing replication, rejected effects, error rates."""
    found: Facts = []
    proved = [one for one in verdict.effects if one.gain is not None]
    if proved:
        found.append(("Replication", _replication(verdict, any(one.other_motion for one in proved))))
    found += [("Not named", _rejected(one, names)) for one in verdict.rejected]
    if verdict.certificate:
        found.append(("Error rates", _certified(verdict.certificate)))
    return found


def _claim(effect: NamedEffect, verdict: Verdict, names: Names) -> Claim:
    assert effect.probability is not None
    said = words(effect.probability, verdict.replicated)
    title = names.title(effect.component, effect.id)
    facts = [("Probability", f"{said}: {chance(effect.probability)}"), *_proof(effect)]
    sentence = names.sentence(effect.sentence)
    if effect.part_of_it:
        title, sentence = f"{PART}{title}", capital(sentence.removeprefix(PART))
    return Claim(title, sentence, said, effect.probability, facts)


def _proof(effect: NamedEffect) -> Facts:
    """The held-out proof of one effect alone."""
    if effect.gain is None:
        return [("Proof", "not computed: an earlier version made this verdict. Diagnose the recording again.")]
    gain = short(effect.gain, 3)
    if effect.gain_ci90:
        low, high = (short(end, 3) for end in effect.gain_ci90)
        gain += f" ({low} to {high}, 90 % interval)"
    facts = [("Own held-out gain", f"{gain} in log score for each block")]
    if effect.share_of_error is not None:
        facts.append(("Own share of the error", f"{_share(effect.share_of_error)} of the held-out error beyond the noise"))
    if effect.blocks is not None:
        motion = "held-out recordings" if effect.other_motion else "the same motion"
        facts.append(("Proved on", f"{effect.blocks} held-out block{'s' * (effect.blocks != 1)} of {motion}"))
    return facts


def _replication(verdict: Verdict, other_motion: bool) -> str:
    if verdict.replicated:
        return "Two or more held-out recordings each confirm every named effect."
    if other_motion:
        return "None: fewer than two held-out recordings confirm every named effect."
    return "None: the proof uses blocks of the same recording. Give held-out recordings with another amplitude or waveform."


def _rejected(effect: RejectedEffect, names: Names) -> str:
    title, reason = names.title(effect.component, effect.id), effect.reason
    if effect.gain is None:
        return f"{title}. {reason}"
    interval = f" ({short(effect.gain_ci90[0], 3)} to {short(effect.gain_ci90[1], 3)})" if effect.gain_ci90 else ""
    return f"{title}. {reason} Own held-out gain: {short(effect.gain, 3)}{interval}."


def _certified(line: Certificate) -> str:
    """The measured error rates of diagnoses of this kind of test, as sentences."""
    rates = (
        ("false alarms on recordings without mismatch", line.false_alarm),
        ("wrong names among the named effects", line.false_discovery),
        ("first names that are right, of effects with λ of at least 100", line.power),
    )
    known = [f"{_rate(rate)} {what}" for what, rate in rates if rate.value is not None]
    made = f"generated {line.kind} tests, seed {line.seed}"
    return f"Measured on {made}: {'; '.join(known)}." if known else f"No case was measured on {made}."


def _rate(rate: Rate) -> str:
    interval = f"{percent(rate.wilson95[0])} to {percent(rate.wilson95[1])} %, " if rate.wilson95 else ""
    return f"{percent(rate.value)} % ({interval}{rate.count} cases)"


def _share(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.01 or share <= 0 else "less than 1 %"
