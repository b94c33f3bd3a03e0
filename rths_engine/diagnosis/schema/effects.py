"""What a diagnosis names: the effects left out with their parameters, and the candidates they were chosen from."""

from __future__ import annotations

from rths_engine.diagnosis.schema.form import AS_STATED, NUMBERS, Form, field


class Parameter(Form):
    """A fitted number of an effect."""

    name: str = field("Name of the field in a plan")
    value: float = field("Fitted value", AS_STATED)
    unit: str = field("SI unit of the value and of its interval; 1 where it has no dimension")
    label: str | None = field("Label for people, with the symbol", default=None)
    shown: str | None = field("Unit for people; empty where it has no dimension", default=None)
    factor: float = field("SI value of one unit for people: value = factor * value for people", AS_STATED, default=1.0)
    ci90: tuple[float, float] = field("Confidence interval at 90 %, [low, high]", AS_STATED)


class NamedEffect(Form):
    """An effect that the models leave out."""

    component: str = field("Where it acts, such as specimen:1, sensor:x_meas.1 or structure:2, which is storey 2")
    id: str = field(
        "Name of the effect in the library; `unknown` where no effect of the library accounts for the mismatch; "
        "`configuration_error` where the controller computed something else than the plan"
    )
    probability: float | None = field(
        "Probability that the effect is present, the sum over the candidates that hold it; "
        "null for `unknown` and `configuration_error`, for which none is computed",
        NUMBERS,
        ge=0,
        le=1,
    )
    sentence: str = field("Place, size and proof of the effect in one or two sentences")
    parameters: tuple[Parameter, ...] = field("Its fitted numbers")


class Candidate(Form):
    """A set of effects that was fitted, with its evidence."""

    effects: tuple[str, ...] = field("Effects as component/id; empty for the planned model")
    probability: float = field("Probability among the models that were fitted", NUMBERS, ge=0, le=1)
    delta_bic: float = field("BIC above the smallest of the models that were fitted", NUMBERS)
    heldout_nrmse: float | None = field(
        "RMS error on held-out data over the RMS of the recorded signal about its mean; null where the simulation runs away",
        NUMBERS,
    )


class NextTest(Form):
    """The test that separates two candidates best within the limits of the rig."""

    separates: tuple[str, str] = field("The two candidates, each its effects as component/id separated by commas")
    signal: str = field("Command of the test: shape, amplitude, frequency and cycles")
    expected_lambda: float = field(
        "Squared distance of the two simulations in units of the noise; from about 10 on they can be told apart", NUMBERS
    )
