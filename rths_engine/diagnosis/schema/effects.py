"""The named effects with their parameters and their proof, the rejected effects, the candidates, and the next test."""

from __future__ import annotations

from typing import Literal

from rths_engine.diagnosis.schema.form import AS_STATED, NUMBERS, Form, field


class Parameter(Form):
    """A fitted parameter of an effect."""

    name: str = field("Field of the plan that holds the parameter")
    value: float = field("Fitted value", AS_STATED)
    unit: str = field("SI unit of the value and of its interval; 1 for a number without dimension")
    label: str | None = field("Label with the symbol, as shown on pages", default=None)
    shown: str | None = field("Unit shown on pages; empty for a number without dimension", default=None)
    factor: float = field("SI value of one shown unit: value = factor * shown value", AS_STATED, default=1.0)
    ci90: tuple[float, float] = field("Confidence interval at 90 %, [low, high]", AS_STATED)


class NamedEffect(Form):
    """A named effect: physics that the model of a component leaves out."""

    component: str = field("Component that the effect acts on, such as specimen:1, sensor:x_meas.1 or structure:2 (storey 2)")
    id: str = field(
        "Name of the effect in the library; `unknown` where no effect of the library explains the mismatch; "
        "`configuration_error` where the controller's output differs from the replay of the plan"
    )
    probability: float | None = field(
        "Calibrated probability that the effect is truly present; null for `unknown` and `configuration_error`",
        NUMBERS,
        ge=0,
        le=1,
    )
    sentence: str = field("Place, size and proof of the effect, in one or more sentences")
    parameters: tuple[Parameter, ...] = field("Fitted parameters of the effect")
    part_of_it: bool = field(
        "True where more than half of the held-out error beyond the noise remains with all named effects: the effect is at "
        "most a part of the mismatch",
        default=False,
    )
    gain: float | None = field(
        "Held-out log score that is lost where this effect alone is left out and everything else is refitted: the mean over "
        "the held-out blocks; null for `unknown` and `configuration_error`",
        NUMBERS,
        default=None,
    )
    gain_ci90: tuple[float, float] | None = field(
        "Confidence interval of the gain at 90 % over the held-out blocks, [low, high]; null with fewer than two blocks",
        NUMBERS,
        default=None,
    )
    share_of_error: float | None = field(
        "Share of the held-out squared error beyond the noise that returns where this effect alone is left out; 1 is all the "
        "error that the planned model leaves; null as the gain",
        NUMBERS,
        default=None,
    )
    blocks: int | None = field("Number of contiguous held-out blocks that the gain is measured on", NUMBERS, default=None)
    other_motion: bool = field(
        "True where the blocks belong to held-out recordings; false where they are held-out blocks of a fitted recording",
        default=False,
    )


class RejectedEffect(Form):
    """An effect that the evidence selected and that the proof of claims did not confirm. It is not named."""

    component: str = field("Component that the effect acts on, as for a named effect")
    id: str = field("Name of the effect in the library")
    contradicted: str | None = field(
        "What in the recording contradicts the effect, in words; null where its held-out gain or its interval rejects it",
        default=None,
    )
    reason: str = field("Reason why the effect is not named, as a sentence")
    gain: float | None = field("Held-out gain of the effect, as for a named effect; null where it was not computed", NUMBERS)
    gain_ci90: tuple[float, float] | None = field("Confidence interval of the gain at 90 %, [low, high]", NUMBERS)


class Candidate(Form):
    """A candidate: a fitted model, that is the planned model with a set of effects, and its evidence."""

    effects: tuple[str, ...] = field("Effects as component/id; empty for the planned model")
    probability: float = field("Probability of the candidate among all fitted models", NUMBERS, ge=0, le=1)
    delta_bic: float = field("BIC of the candidate minus the smallest BIC of all fitted models", NUMBERS)
    heldout_nrmse: float | None = field(
        "Held-out error: RMS error on held-out data over the RMS of the recorded signal about its mean; "
        "null where the simulation diverges",
        NUMBERS,
    )


class NextTest(Form):
    """The test within the limits of the rig that separates two candidates best, or tells most about an unknown."""

    separates: tuple[str, ...] = field(
        "The two candidates; each is a list of effects, component/id, separated by commas. Empty for a test of an unknown"
    )
    signal: str = field("Command of the test: shape, amplitude, frequency and cycles")
    expected_lambda: float | None = field(
        "Squared distance λ of the two simulations in units of the noise; a test separates two candidates from 10 on; null for "
        "a test of an unknown",
        NUMBERS,
    )
    tells: str | None = field(
        "What a test of an unknown would tell, as a sentence; null for a test of two candidates", default=None
    )
    waveform: Literal["sine", "triangle", "recorded"] | None = field(
        "Shape of the command; recorded is the recorded excitation of a structure; null in older verdicts", default=None
    )
    amplitude: float | None = field("Amplitude of a sine or a triangle", "m", default=None)
    frequency: float | None = field("Frequency of a sine or a triangle", "Hz", default=None)
    cycles: int | None = field("Number of cycles of a sine or a triangle", NUMBERS, default=None)
    factor: float | None = field("Factor on the recorded excitation of a structure", NUMBERS, default=None)
