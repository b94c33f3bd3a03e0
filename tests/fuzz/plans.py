"""Random plans within the declared bounds of every field, run for a short time."""

from __future__ import annotations

import json
import math
import types
from collections.abc import Iterator
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types
import numpy as np
from hypothesis import strategies as st
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rths_engine.foundation.errors import RthsError
from rths_engine.parts.connections.emulated import Emulated
from rths_engine.planning import templates
from rths_engine.planning.kinds_of_test import TESTS
from rths_engine.planning.motion import FileMotion, RecordMotion
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_model, read_plan
from rths_engine.running.client_run import ClientRun
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY
from tests.fuzz import trying

LONGEST_S = 0.3
MOST_ITEMS = 4  # of a list: storeys, stations, effects
MOST_CHANGES = 6
MOST_SUBSTEPS = 30_000
TEMPLATES = {name: templates.template(name) for name in templates.names()}
STARTS = {test: [name for name, plan in TEMPLATES.items() if plan.test == test] for test in TESTS}
# fields that are not drawn
OF_THE_MACHINE = ("connection", "pace", "client", "template", "schema_", "test", "known", "duration")
TARGETS_M = (1e-6, -1e-3, 1e-3, 0.0, 0.02, -0.02, 1e3)
RECORDS = LIBRARY.names()[:3]


def faults(examples: int, seed: int) -> Iterator[str]:
    """What is wrong with the runs of `examples` random plans."""
    for test in STARTS:  # its code is compiled here, not in the time of a plan
        _wrong(_short(TEMPLATES[STARTS[test][0]].as_dict(), 0.01))
    yield from trying.faults(PLANS, _wrong, examples, seed)


def _wrong(data: dict[str, Any]) -> str | None:
    try:
        model = read_model(data)
        if model.plan.test == "client":
            run: Run | ClientRun = _led(ClientRun(model))
        else:
            run = Run(model, LIBRARY)
            if run.total > MOST_SUBSTEPS:
                return None
            run.advance(run.total)
    except RthsError as error:
        return None if error.issues and all(one.problem for one in error.issues) else f"a refusal without a reason: {data}"
    result = run.result("tripped" if run.trip else "completed", 0.0)
    summary = result.summary()
    told = json.dumps(data)
    json.dumps(summary, allow_nan=False)
    if not run.finished:
        return f"a run that does not end: {told}"
    if run.trip is None and not (np.isfinite(run.signals).all() and np.isfinite(run.history).all()):
        return f"a completed run with values that are not finite: {told}"
    if run.trip is not None and not run.trip.sentence:
        return f"a trip without a reason: {told}"
    again = read_plan(json.loads(json.dumps(model.plan.as_dict())))
    return None if again.digest == model.plan.digest else f"a plan that is another one after JSON: {told}"


def _led(run: ClientRun) -> ClientRun:
    """The run after what a client does: ramps to displacements that grow, as many as the digest of the plan says."""
    steps = max(1, min(run.total, MOST_SUBSTEPS) // len(TARGETS_M))
    for target in TARGETS_M[: 1 + int(run.plan.digest[:4], 16) % len(TARGETS_M)]:
        if not run.finished and run.done + steps <= run.total:
            run.ramp([target] * len(run.plan.stations), steps)
            run.advance(steps)
    run.finished = True
    return run


def _value(draw: st.DrawFn, kind: Any, bounds: tuple[Any, ...] = ()) -> Any:
    """A value of an annotation, within its bounds."""
    origin = get_origin(kind)
    if origin is Annotated:
        inner, *more = get_args(kind)
        more = [bound for one in more for bound in (one.metadata if isinstance(one, FieldInfo) else [one])]
        return _value(draw, inner, (*bounds, *more))
    if origin in (Union, types.UnionType):
        chosen = draw(st.sampled_from([one for one in get_args(kind) if one is not FileMotion]))
        return None if chosen is type(None) else _value(draw, chosen, bounds)
    if origin is Literal:
        return draw(st.sampled_from(get_args(kind)))
    if origin is tuple:
        low, high = _length(bounds)
        count = draw(st.integers(low, max(low, min(high, MOST_ITEMS))))
        inner = get_args(kind)[0]
        return [_value(draw, inner, () if _is_list(inner) else _of_items(bounds)) for _ in range(count)]
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        return _model(draw, kind)
    if kind is bool:
        return draw(st.booleans())
    if kind is int:
        least, most = _span(bounds)
        return draw(st.integers(math.ceil(max(least, -3)), math.floor(min(most, max(least, 0) + 8))))
    if kind is float:
        return _float(draw, bounds)
    return draw(st.sampled_from(["a", "Rig 1", "é" * 3]))


def _is_list(kind: Any) -> bool:
    return get_origin(kind) is tuple


def _float(draw: st.DrawFn, bounds: tuple[Any, ...]) -> float:
    """A number within the bounds: near an end, or of any size."""
    low, high = _span(bounds)
    size = draw(st.sampled_from([0.0, 1.0, -1.0]) | st.floats(-8, 9).map(lambda power: 10**power))
    drawn = draw(st.sampled_from([size, size, size, -size, low, high]))
    drawn = min(max(drawn, low), high)
    strict = {one.gt for one in bounds if isinstance(one, annotated_types.Gt)} | {
        one.lt for one in bounds if isinstance(one, annotated_types.Lt)
    }
    if drawn in strict or not math.isfinite(drawn):
        drawn = 0.5 * (max(low, -1e3) + min(high, max(low, 0) + 1.0))
    return drawn


def _span(bounds: tuple[Any, ...]) -> tuple[float, float]:
    lows: list[Any] = [one.ge if isinstance(one, annotated_types.Ge) else one.gt for one in bounds if _is(one, "Ge", "Gt")]
    highs: list[Any] = [one.le if isinstance(one, annotated_types.Le) else one.lt for one in bounds if _is(one, "Le", "Lt")]
    return float(max(lows, default=-1e9)), float(min(highs, default=1e9))


def _of_items(bounds: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(one for one in bounds if not _is(one, "MinLen", "MaxLen"))


def _length(bounds: tuple[Any, ...]) -> tuple[int, int]:
    low = max([one.min_length for one in bounds if _is(one, "MinLen")], default=0)
    return low, min([one.max_length for one in bounds if _is(one, "MaxLen")], default=MOST_ITEMS)


def _is(bound: Any, *names: str) -> bool:
    return isinstance(bound, tuple(getattr(annotated_types, name) for name in names))


def _model(draw: st.DrawFn, kind: type[BaseModel]) -> dict[str, Any]:
    """A part: its required fields, and some of the others."""
    found: dict[str, Any] = {}
    for name, field in kind.model_fields.items():
        if name in OF_THE_MACHINE:
            continue
        if name == "kind":
            found[name] = field.default
        elif name == "record" and kind is RecordMotion:
            found[name] = draw(st.sampled_from(RECORDS))
        elif name == "sha256":
            continue
        elif field.is_required() or get_origin(field.annotation) is Literal or draw(st.integers(0, 3)) == 0:
            found[name] = _value(draw, field.annotation, tuple(field.metadata))
    return found


def _changed(draw: st.DrawFn, value: BaseModel, test: str) -> dict[str, Any]:
    """The part with another value in one of its fields, or in a field of a part of it."""
    data = value.model_dump(mode="json", by_alias=True)
    unused = {name for name, field in type(value).model_fields.items() if not _used(field, test)}
    names = [name for name in type(value).model_fields if name not in {*OF_THE_MACHINE, *unused, "kind", "sha256"}]
    if not names:
        return data
    name = draw(st.sampled_from(names))
    field, held = type(value).model_fields[name], getattr(value, name)
    if isinstance(held, tuple) and held and isinstance(held[0], BaseModel) and draw(st.integers(0, 4)):
        at = draw(st.integers(0, len(held) - 1))
        data[name][at] = _changed(draw, held[at], test)
    elif isinstance(held, BaseModel) and not isinstance(held, Emulated) and draw(st.booleans()):
        data[name] = _changed(draw, held, test)
    else:
        data[name] = _value(draw, field.annotation, tuple(field.metadata))
    return data


@st.composite
def _plans(draw: st.DrawFn) -> dict[str, Any]:
    """A template with up to MOST_CHANGES changes, each of which keeps the bounds of its field."""
    plan = TEMPLATES[draw(st.sampled_from(list(STARTS)).flatmap(lambda test: st.sampled_from(STARTS[test])))]
    data = _short(plan.as_dict(), draw(st.sampled_from([0.01, 0.1, LONGEST_S])))
    for _ in range(draw(st.integers(1, MOST_CHANGES))):
        changed = _short(_changed(draw, Plan.model_validate(data), plan.test), data["duration"])
        try:
            read_plan(changed)
        except RthsError:  # of several fields together
            if draw(st.integers(0, 9)) == 0:
                return changed
            continue
        data = changed
    return data


def _short(data: dict[str, Any], duration: float) -> dict[str, Any]:
    """The plan as a short test, as fast as possible, with the integration step that fits its controller rate."""
    integrator = data["integrator"]
    fitting = {**integrator, "dt": integrator.get("substeps", 1) / data["controller_rate"]}
    return {**data, "duration": duration, "pace": {"kind": "fastest"}, "client": {}, "integrator": fitting}


def _used(field: FieldInfo, test: str) -> bool:
    extra = field.json_schema_extra
    declared: dict[str, Any] = dict(extra) if isinstance(extra, dict) else {}
    tests = [*declared.get("tests", []), *declared.get("one_in", [])]
    return not tests or test in tests


PLANS = _plans()
