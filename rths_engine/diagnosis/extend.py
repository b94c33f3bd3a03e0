"""The extended plan: the plan with refitted parameters and the named effects."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rths_engine.diagnosis.components.component import Loose
from rths_engine.diagnosis.judge import Judged
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.planning.plan import Plan

# chosen; see docs/decisions/0023
LEAST = 1e-6  # smallest relative change of a structure's parameter that is kept
MOST = 8  # effects of a component, the limit of a plan


def extended(plan: Plan, judged: Sequence[Judged]) -> Plan | None:
    """The extended plan; None where no effect was named."""
    if not any(one.effects for one in judged):
        return None
    for one in judged:
        if one.effects:
            plan = _station(plan, one) if ":" in one.component.name else _structure(plan, one)
    return plan


def _station(plan: Plan, one: Judged) -> Plan:
    place = int(one.component.station) - 1
    stations = list(plan.stations)
    station = stations[place]
    chosen = one.selection.chosen.parts
    update: dict[str, Any] = {}
    for part in chosen[: len(one.component.base)]:
        if not isinstance(part, Effect | Loose):
            update["actuator" if type(part) is type(station.actuator) else "specimen"] = part
    for field, kinds in _FIELDS.items():
        own = tuple(part for part in chosen if isinstance(part, kinds))
        if own:
            update[field] = (own if field != "sensor_physics" else (*station.sensor_physics, *own))[:MOST]
    stations[place] = station.model_copy(update=update)
    return plan.model_copy(update={"stations": tuple(stations)})


def _structure(plan: Plan, one: Judged) -> Plan:
    base = one.selection.chosen.parts[: len(one.component.base)]
    moved = [part for part in base if isinstance(part, Effect) and abs(getattr(part, "share", 0.0)) > LEAST]
    own = [effect for effect in one.effects if isinstance(effect, physics.STRUCTURE)]
    ground = [effect for effect in one.effects if isinstance(effect, physics.INPUT)]
    return plan.model_copy(
        update={
            "structure_physics": (*plan.structure_physics, *own, *moved)[:MOST],
            "motion_physics": (*plan.motion_physics, *ground)[:MOST],
        }
    )


_FIELDS = {
    "actuator_physics": physics.ACTUATOR,
    "specimen_physics": physics.SPECIMEN,
    "sensor_physics": physics.SENSOR,
}
