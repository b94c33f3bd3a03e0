"""The forms of a diagnosis: every field says what it means and in which unit, and nothing that is not computed has a number."""

from __future__ import annotations

import json
import math
import typing
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.named import configuration_error
from rths_engine.diagnosis.schema import Errors, Form, Pictures, Verdict
from rths_engine.diagnosis.schema.form import finite
from rths_engine.diagnosis.verdict import diagnose
from rths_engine.foundation.errors import RecordingError, renamed
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.planning import templates
from rths_engine.recordings import opening, run_file
from rths_engine.recordings.measured import Measured
from rths_engine.running.run import simulate
from tests.engine import recorded_specimens as made


def forms(kind: Any) -> Iterator[type[Form]]:
    """The form and every form inside it, or inside the type of a field."""
    if isinstance(kind, type) and issubclass(kind, Form):
        yield kind
        for field in kind.model_fields.values():
            yield from forms(field.annotation)
    for inner in typing.get_args(kind):
        yield from forms(inner)


def numeric(kind: Any) -> bool:
    return kind in (float, int) or any(numeric(inner) for inner in typing.get_args(kind))


FIELDS = {
    f"{form.__name__}.{name}": field
    for root in (Verdict, Pictures)
    for form in forms(root)
    for name, field in form.model_fields.items()
}


@pytest.mark.parametrize("name", FIELDS)
def test_every_field_has_a_meaning_and_every_number_a_unit(name: str) -> None:
    field = FIELDS[name]
    extra = field.json_schema_extra
    assert field.description and field.description[0].isupper() and not field.description.endswith(".")
    assert bool(isinstance(extra, dict) and extra.get("unit")) == numeric(field.annotation)


@pytest.mark.parametrize("form", [Verdict, Pictures])
def test_the_published_schema_requires_every_field_and_allows_no_other(form: type[Form]) -> None:
    schema = form.json_schema()
    for one in (schema, *schema["$defs"].values()):
        assert one["additionalProperties"] is False and one["required"] == list(one["properties"])
    assert schema["properties"]["schema"]["const"] == form.model_fields["version"].default


def test_a_number_that_is_not_finite_is_null_and_never_a_stand_in() -> None:
    with pytest.raises(ValidationError):
        Errors(fit_nrmse=math.inf, heldout_nrmse=None)
    assert finite(math.inf) is None and finite(math.nan) is None and finite(0.5) == 0.5


def test_a_computed_part_has_no_noise_and_no_probability(tmp_path: Path) -> None:
    """A hybrid test whose compensator ran with another setting than planned; its structure was computed as planned."""
    two = templates.template("two-storeys").model_copy(update={"duration": 6.0})
    plan = two.model_copy(update={"stations": two.stations[:1]})
    run_file.save(tmp_path / "test.h5", simulate(plan))
    station = plan.stations[0].model_copy(update={"compensator": AdaptiveInverseCompensation(alpha_es=29.0)})
    other = plan.model_copy(update={"stations": (station,)})
    found = diagnose(other, opening.load(tmp_path / "test.h5")).verdict
    compensator, structure, *simulated = found.components
    assert (compensator.component, structure.component) == ("compensator:1", "structure")
    assert (compensator.verdict, compensator.mismatch) == ("configuration_error", True)
    assert (structure.verdict, structure.mismatch) == ("consistent", False)
    assert {(one.p_value, one.noise_nrmse) for one in (compensator, structure)} == {(None, None)}
    assert simulated and all(one.p_value is not None and one.noise_nrmse is not None for one in simulated)
    assert found.verdict == "configuration_error"
    assert (found.effects[0].id, found.effects[0].probability) == ("configuration_error", None)
    assert Verdict.read(json.loads(json.dumps(found.as_dict(), allow_nan=False))) == found


def test_a_replay_that_runs_away_is_said_to_without_a_number() -> None:
    found = configuration_error(Replayed("structure", math.inf, math.inf, "the command of Damper"))
    assert "the replay diverges" in found.sentence and "inf" not in found.sentence


def test_an_input_that_can_not_be_used_is_named_by_its_argument() -> None:
    whole = made.recording(6)
    short = Measured(whole.dt, tuple(replace(one, values=one.values[:100]) for one in whole.channels))
    for arguments, where in (((short,), "recording"), ((whole, [whole, short]), "heldout.1")):
        with pytest.raises(RecordingError) as refused:
            diagnose(made.plan(), *arguments)
        assert [issue.where for issue in refused.value.issues] == [where]
    with pytest.raises(RecordingError) as refused:
        diagnose(made.plan(), whole, more=[short])
    assert [issue.where for issue in refused.value.issues] == ["more.0"]
    here = renamed(refused.value, {"more.0": "--with short.h5", "more": "--with"})
    assert str(here).startswith("--with short.h5: has 100 samples") and type(here) is RecordingError
