"""Plans as YAML text: what is read, what is refused, and how long names and numbers may be."""

from __future__ import annotations

import json
from io import StringIO
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

from rths_engine.foundation.errors import PlanError
from rths_engine.planning import plan_yaml
from rths_engine.planning.plan_yaml import DEEPEST

DERANDOMISED = settings(max_examples=200, derandomize=True)
SCALARS = (
    "0 -1 +1 1e5 1e-5 1E+5 .5 1. 010 0o17 0x1F -0b11 1_000 1_0.5 .inf -.Inf .NaN 1e999 "
    "~ null Null true FALSE yes on 1e 0x _1 .5x 1:30 2x nan inf . + 0o9 x<<y"
)
VALUES = st.none() | st.booleans() | st.integers() | st.floats() | st.text(st.characters(exclude_categories=["Cs", "Cc"]))
KEYS = st.text("abcdefghij_ é", min_size=1)
DATA = st.recursive(VALUES, lambda some: st.lists(some, max_size=4) | st.dictionaries(KEYS, some, max_size=4), max_leaves=12)


def by_ruamel(text: str) -> Any:
    return YAML(typ="safe", pure=True).load(text)


@pytest.mark.parametrize("scalar", SCALARS.split())
def test_a_scalar_means_what_yaml_1_2_says(scalar: str) -> None:
    assert repr(plan_yaml.parse(f"a: {scalar}")) == repr(by_ruamel(f"a: {scalar}"))


@DERANDOMISED
@given(data=DATA)
def test_what_another_writer_wrote_is_read_as_it_was(data: Any) -> None:
    stream = StringIO()
    YAML(typ="safe", pure=True).dump({"data": data}, stream)
    read, written = (json.dumps(one, sort_keys=True) for one in (plan_yaml.parse(stream.getvalue()), {"data": data}))
    assert read == written


@DERANDOMISED
@given(text=st.text() | st.text("{}[]-:?&*!|>'\"%@`#,\n \tab01.e<=~"))
def test_any_text_is_data_or_is_refused_with_a_reason(text: str) -> None:
    try:
        plan_yaml.parse(text)
    except PlanError as error:
        assert error.issues[0].problem


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a: &x [1]\nb: *x", "line 2: YAML aliases"),
        ("a: 1\nseed: !!int x", "line 2: YAML tags"),
        ("a: !!python/object:os.system {}", "YAML tags"),
        ("a: 1\nb: 2\na: 3", "line 3: the field a is given twice"),
        ("? [a]\n: b", "cannot be the name of a field"),
        ("a: 1\n---\nb: 2", "line 2: the text has a second document"),
        ("[" * (DEEPEST + 1), "nested deeper"),
        ("[" * 100_000, "nest"),
        ("a: " + "9" * 5000, "5000 digits"),
        ("a: 0b" + "1" * 5000, "digits"),
        ('a: "\\UFFFFFFFF"', "not valid YAML"),
        ("a: [", "line 2: the text is not valid YAML"),
        ("a: \ud800", "not valid YAML"),
        ("a: \x07", "not valid YAML"),
    ],
)
def test_a_mistake_is_refused_with_its_line(text: str, told: str) -> None:
    with pytest.raises(PlanError) as refused:
        plan_yaml.parse(text)
    assert told in str(refused.value) and len(str(refused.value)) < 400
