"""`rths identify`: the delay of a station by a short random test, with what follows for the compensator of the plan."""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from app.cli.run_input import model_of_plan
from rths_engine.foundation.part import validated
from rths_engine.identification import RandomTest
from rths_engine.identification import identify as by_random_test


def identify(given: Namespace) -> int:
    """`rths identify`: print the models of the station's actuator with 95 % intervals. The plan is not changed."""
    asked = {"seconds": given.seconds, "low_frequency": given.low, "high_frequency": given.high, "seed": given.seed}
    if given.amplitude is not None:
        asked["amplitude"] = given.amplitude
    found = by_random_test(model_of_plan(given.plan).plan, given.station, validated(RandomTest, asked), given.rig)
    print(json.dumps(found) if given.json else "\n".join(_lines(found)))
    return 0


def _lines(found: dict[str, Any]) -> Iterator[str]:
    band = f"{found['low_frequency']:g} to {found['high_frequency']:g} Hz"
    amplitude = f"{1e3 * found['amplitude']:.3g} mm"
    yield f"Station {found['station']} ({found['name']}): {found['seconds']:g} s of noise from {band}, peak {amplitude}"
    delay, best = found["delay"], next(one for one in found["models"] if one["kind"] == found["best"])
    value, low, high = (f"{1e3 * delay[key]:.3g}" for key in ("value", "low", "high"))
    yield f"Delay {value} ms (95 % interval {low} to {high} ms) by the model '{best['title']}'"
    yield f"Mean coherence in the band {found['coherence']:.3f}"
    yield ""
    yield f"{'Model':28} {'Parameter':22} {'Value':>10} {'from':>10} {'to':>10} {'Unit':6} Residual"
    for model in found["models"]:
        for number, one in enumerate(model["parameters"]):
            title, residual = (model["title"], f"{100 * model['residual']:.2g} %") if number == 0 else ("", "")
            shown = " ".join(f"{one[key] / one['factor']:>10.4g}" for key in ("value", "low", "high"))
            numbers = shown if one["determined"] else f"{'not determined':>32}"
            yield f"{title:28} {one['label']:22} {numbers} {one['shown_label']:6} {residual}".rstrip()
    for one in found["suggested"]:
        values = [f"{one[key] / one['factor']:.4g} {one['shown_label']}".rstrip() for key in ("value", "present")]
        yield f"{one['path']}: {values[0]} (now {values[1]})"
    yield from found["notes"]
