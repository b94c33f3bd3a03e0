"""The cards of running tests on the Lab page: progress, curves, the smallest margin to a limit, and the measures so far."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.live.hub import LiveRun
from app.models import Run
from app.pages.sparkline import path
from rths_engine.planning.plan import Plan
from rths_engine.results.channels import CHANNELS, Channel
from rths_engine.results.measures import MEASURES

CURVES = (("x_cmd", "x_meas"), ("ti",), ("x_floor",))  # roles of each curve; the last only without a station
NEAR = 0.8  # share of a limit from which the card says that it is near
LIMITED = (("displacement", "x_cmd", "stroke"), ("velocity", "v_cmd", "velocity"), ("force", "f_meas", "force"))


@dataclass(frozen=True, slots=True)
class Curve:
    """A small curve: its label with the unit, its newest value, and a path for each of its signals."""

    label: str
    value: str
    paths: list[str]


@dataclass(frozen=True, slots=True)
class Margin:
    """The largest share of a safety limit so far, in words; `name` is ok, near or over."""

    name: str
    words: str


@dataclass(frozen=True, slots=True)
class Card:
    """A running test as the Lab page shows it."""

    run: Run
    simulated_s: float
    elapsed_s: float
    curves: list[Curve]
    margin: Margin | None
    measures: list[tuple[str, str]]


def card(run: Run, plan: Plan, live: LiveRun | None) -> Card:
    """The card of a running test. Before the worker's first message it has no curves."""
    if live is None or not live.store.count:
        return Card(run, 0.0, 0.0, [], None, [])
    progress = live.progress or {}
    signals = live.store.values()
    roles = [(one["role"], one["number"]) for one in live.schema["channels"]]
    return Card(
        run,
        progress.get("simulated_s", 0.0),
        progress.get("elapsed_s", 0.0),
        list(_curves(roles, signals, len(signals) if live.schema.get("open_ended") else live.schema["buckets"])),
        _margin(plan, roles, signals),
        list(_measures(progress.get("measures") or {})),
    )


def _curves(roles: list[tuple[str, int | None]], signals: Any, buckets: int) -> Iterator[Curve]:
    """The displacement and the tracking indicator of the first station, or the displacement of the highest floor."""
    for wanted in CURVES if ("x_cmd", 1) not in roles else CURVES[:-1]:
        columns = [max((k for k, one in enumerate(roles) if one[0] == role and _first(one)), default=None) for role in wanted]
        shown = [column for column in columns if column is not None]
        if len(shown) < len(wanted):
            continue
        extremes = signals[:, shown, :2]
        finite = np.abs(extremes[np.isfinite(extremes)])
        scale = float(finite.max()) if len(finite) else 0.0
        channel = Channel(wanted[-1], roles[shown[-1]][1], "")
        where = "floor" if wanted == ("x_floor",) else "station"
        label = f"{CHANNELS[channel.role].label}, {where} {channel.number}"
        newest = f"{signals[-1, shown[-1], 2]:.3g} {channel.shown_label}"
        yield Curve(label, newest, [path(signals[:, k, 0], signals[:, k, 1], buckets, scale) for k in shown])


def _first(channel: tuple[str, int | None]) -> bool:
    return channel[0] == "x_floor" or channel[1] == 1


def _margin(plan: Plan, roles: list[tuple[str, int | None]], signals: Any) -> Margin | None:
    found = []
    for number, station in enumerate(plan.stations, start=1):
        for field, role, label in LIMITED:
            if (role, number) in roles:
                limit = getattr(station.limits, field) / Channel(role, number, "").factor
                peak = np.nanmax(np.abs(signals[:, roles.index((role, number)), :2]))
                found.append((float(peak / limit), f"{label} of station {number}"))
    if not found:
        return None
    share, what = max(found)
    name = "over" if share >= 1 else "near" if share >= NEAR else "ok"
    return Margin(name, f"{100 * share:.0f} % of the limit on {what}")


def _measures(shown: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Heading and value of the listed measures so far: those of each station, then those of the whole test."""
    stations = shown.get("stations", [])
    for one in MEASURES:
        if one.listed and one.scope == "station" and any(station.get(one.key) is not None for station in stations):
            yield one.heading, " / ".join(one.text(station.get(one.key)) for station in stations)
        elif one.listed and one.scope == "run" and shown.get(one.key) is not None:
            yield one.heading, one.text(shown[one.key])
