"""Contract of every left-out effect: neutral, nested, bounded, said in a sentence, the same compiled and in Python."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Any

import annotated_types
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import Value, validated
from rths_engine.parts import physics, specimens
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.effect import F_SENSOR, GROUND, MATRICES, PART, X_SENSOR, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.running import replay
from tests.engine.effects import CURRENT, DT, PATH, SEEN, building, signals, streamed

REGISTRIES = ("SPECIMEN", "ACTUATOR", "SENSOR", "STRUCTURE", "INPUT")
SEARCHES = [physics.SEARCHES[kind] for kind in physics.KINDS]
GUESSES: list[Effect] = [guess for search in SEARCHES for guess in search.guesses(SEEN)]
UNITS = r"(%|\d A\b|\bm?m\b|kN|\bkg\b|\bm?s\b|Hz|MJ|/s\b|by the exponent)"
BEFORE = (PART, MATRICES, GROUND)


def named(guess: Effect) -> str:
    return f"{type(guess).__module__.rsplit('.', 2)[1]}-{guess.kind}"  # type: ignore[attr-defined]


def says(effect: Effect) -> str:
    return physics.SEARCHES[type(effect)].says(effect)


def of(hook: int) -> Any:
    """What an effect at a hook acts on, here."""
    if hook == PART:
        return FirstOrderDelay()
    if hook == MATRICES:
        return building()
    return PATH if hook == GROUND else signals(hook)[0]


def acted(effect: Effect) -> Any:
    if effect.hook == PART:
        return effect.amended(of(PART))
    if effect.hook == MATRICES:
        return effect.assembled(of(MATRICES))
    if effect.hook == GROUND:
        return effect.shaken(of(GROUND), DT)
    return streamed(effect, signals(effect.hook))


def flat(value: Any) -> np.ndarray:
    """Every number of a part, a structure or a signal."""
    if isinstance(value, FirstOrderDelay):
        return value.build(DT)[0]
    return np.concatenate([np.ravel(one) for one in value[:4]]) if isinstance(value, tuple) else value


@pytest.mark.parametrize("guess", GUESSES, ids=named)
def test_an_effect_vanishes_at_its_neutral_values(guess: Effect) -> None:
    neutral = guess.model_copy(update=dict(guess.neutral))
    before = flat(of(guess.hook))
    np.testing.assert_allclose(flat(acted(neutral)), before, rtol=1e-12, atol=1e-15 * np.abs(before).max())


@pytest.mark.parametrize("kind", physics.SPECIMEN, ids=lambda kind: kind.model_fields["kind"].default)
def test_every_specimen_stays_itself_beside_a_neutral_effect(kind: type[Effect]) -> None:
    neutral = next(iter(physics.SEARCHES[kind].guesses(SEEN))).model_copy(update=dict(kind.neutral))
    for part in (specimen() for specimen in specimens.KINDS):
        plain = replay.specimen(part, [], PATH, CURRENT, DT)
        np.testing.assert_allclose(replay.specimen(part, [neutral], PATH, CURRENT, DT), plain, rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize("guess", GUESSES, ids=named)
def test_an_effect_changes_something_at_each_of_its_guesses(guess: Effect) -> None:
    before, after = flat(of(guess.hook)), flat(acted(guess))
    assert np.isfinite(after).all()
    assert len(after) != len(before) or (np.abs(after - before) > 1e-6 * np.abs(after)).any()


@pytest.mark.parametrize("search", SEARCHES, ids=lambda search: search.effect.__name__)
def test_an_effect_is_looked_for_from_few_sizes_and_moments(search: Search[Effect]) -> None:
    guesses = list(search.guesses(SEEN))
    moments = {getattr(guess, "time", 0.0) for guess in guesses}
    assert 1 <= len(moments) <= 8 and len(moments) <= len(guesses) <= 4 * len(moments)


@pytest.mark.parametrize("search", SEARCHES, ids=lambda search: search.effect.__name__)
def test_guesses_keep_their_bounds_whatever_was_seen(search: Search[Effect]) -> None:
    for size in (0.0, 1e-30, 1e30):
        for guess in search.guesses(Seen(size, size, 1 / max(size, 1e-30), size, size, DT)):
            assert search.effect.model_validate(guess.model_dump()) == guess
            assert search.says(guess)


@pytest.mark.parametrize("guess", GUESSES, ids=named)
def test_the_sentence_says_size_and_unit_and_what_was_left_out(guess: Effect) -> None:
    middle = says(guess)
    sentence = f"The first one {middle}: {physics.SEARCHES[type(guess)].noun} was left out."
    assert re.search(rf"\d.*{UNITS}|{UNITS}.*\d", middle), sentence
    assert "e+" not in sentence and "  " not in sentence and middle[0].islower() and not middle.endswith(".")


@pytest.mark.parametrize("guess", [guess for guess in GUESSES if hasattr(guess, "time")], ids=named)
def test_the_sentence_of_an_event_says_when(guess: Effect) -> None:
    assert f"{guess.time:.3g} s" in says(guess)  # type: ignore[attr-defined]


@pytest.mark.parametrize("kind", physics.KINDS, ids=lambda kind: kind.__name__)
def test_an_effect_declares_its_equation_and_label_unit_and_bounds_of_each_number(kind: type[Effect]) -> None:
    search = physics.SEARCHES[kind]
    summary, _, rest = (kind.__doc__ or "").partition("\n\n")
    assert kind.title and search.noun and search.needs and summary.endswith(".")
    assert re.search(r"[=<+]|K|M", (rest or summary).splitlines()[0])
    for name, field in kind.model_json_schema()["properties"].items():
        assert field["title"]
        if name not in ("kind", "channel", "side"):
            assert {"unit", "shown", "factor"} <= field.keys()
            assert {"maximum"} <= field.keys() and {"minimum", "exclusiveMinimum"} & field.keys()
    assert set(kind.neutral) | {*search.held, *search.otherwise} <= set(kind.model_fields)


def test_titles_differ_and_relatives_are_effects() -> None:
    for registry in REGISTRIES:
        titles = [kind.title for kind in getattr(physics, registry)]
        assert len(set(titles)) == len(titles)
    known = {kind.model_fields["kind"].default for kind in physics.KINDS}
    assert all(set(search.relatives) <= known for search in SEARCHES)


def test_a_law_knows_nothing_of_the_search_for_it() -> None:
    own = {name for name in vars(Search) if not name.startswith("_")}
    assert own and not [(kind, name) for kind in physics.KINDS for name in own & set(dir(kind))]


@pytest.mark.parametrize("kind", physics.KINDS, ids=lambda kind: kind.__name__)
def test_numbers_out_of_bounds_are_refused_with_the_bound(kind: type[Effect]) -> None:
    for name, field in kind.model_fields.items():
        for bound in field.metadata:
            if isinstance(bound, annotated_types.Le):
                with pytest.raises(PlanError, match=rf"{name} = .*: needs a value <= "):
                    validated(kind, {name: 2 * bound.le})  # type: ignore[operator]
            elif isinstance(bound, annotated_types.Gt | annotated_types.Ge):
                low: Any = bound.gt if isinstance(bound, annotated_types.Gt) else bound.ge
                with pytest.raises(PlanError, match=rf"{name} = .*: needs a value >"):
                    validated(kind, {name: low - 1 - abs(low)})
        if field.annotation is float:
            with pytest.raises(PlanError, match="finite number"):
                validated(kind, {name: float("nan")})


class Listed(Value):
    specimen: tuple[physics.SpecimenEffect, ...] = ()
    actuator: tuple[physics.ActuatorEffect, ...] = ()
    sensor: tuple[physics.SensorEffect, ...] = ()
    structure: tuple[physics.StructureEffect, ...] = ()
    input: tuple[physics.InputEffect, ...] = ()


@pytest.mark.parametrize("guess", GUESSES, ids=named)
def test_an_effect_is_read_back_from_what_it_writes(guess: Effect) -> None:
    component = type(guess).__module__.rsplit(".", 2)[1]
    assert getattr(Listed.model_validate({component: [guess.model_dump(mode="json")]}), component) == (guess,)


def test_a_wrong_number_in_a_list_of_effects_is_named_by_its_path() -> None:
    with pytest.raises(PlanError, match=r"^sensor\.0\.error = 5"):
        validated(Listed, {"sensor": [{"kind": "offset", "channel": "x_meas", "error": 5.0}]})


@pytest.mark.parametrize("guess", [guess for guess in GUESSES if guess.hook not in BEFORE], ids=named)
def test_the_compiled_step_equals_the_python_step(guess: Effect) -> None:
    y, x, v, w = (signal[:600] for signal in signals(guess.hook))
    parameters, state = guess.build(DT)
    plain = [guess.step(parameters, state, y[q], x[q], v[q], w[q], q * DT, DT) for q in range(600)]
    # pow and exp differ by an ulp between compiled and Python
    np.testing.assert_allclose(streamed(guess, (y, x, v, w)), plain, rtol=1e-11, atol=1e-15)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 4), min_size=2, max_size=6))
def test_an_effect_makes_a_number_of_every_number(rows: list[tuple[float, float, float, float]]) -> None:
    for guess in GUESSES:
        parameters, state = guess.build(DT)
        for q, (y, x, v, w) in enumerate(rows):
            assert np.isfinite(guess.step(parameters, state, y, x, v, w, 3 * q, DT))


def test_a_sensor_effect_acts_on_its_own_channel() -> None:
    for displacement, force in pairwise(physics.SENSOR):
        if displacement.model_fields["kind"].default == force.model_fields["kind"].default:
            assert (displacement.hook, force.hook) == (X_SENSOR, F_SENSOR)
            assert displacement().channel, force().channel == ("x_meas", "f_meas")  # type: ignore[attr-defined]
