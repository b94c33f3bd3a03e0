"""The generated tables by name."""

from __future__ import annotations

from collections.abc import Callable

from app.documents import commands, decisions, diagnosis, effects, formats, league, outputs, parts, rooms, routes, settings
from rths_engine.parts import actuators, compensators, controllers, integrators, physics, specimens, structures
from rths_engine.planning.coupling import KINDS
from rths_engine.planning.shapes import SHAPES

TABLES: dict[str, Callable[[], str]] = {
    "imported channels": outputs.imported_channels,
    "units of columns": outputs.units_of_columns,
    "channels": outputs.channels,
    "measures": lambda: outputs.measures(further=False),
    "further measures": lambda: outputs.measures(further=True),
    "measures of floors and tests": outputs.measures_of_tests,
    "glossary": outputs.terms,
    "fields of a verdict": diagnosis.verdict_fields,
    "probabilities in words": diagnosis.chances,
    "fields of the plots": diagnosis.pictures_fields,
    "structures": lambda: parts.kinds(structures.KINDS),
    "integrators": lambda: parts.kinds(integrators.KINDS),
    "compensators": lambda: parts.kinds(compensators.KINDS),
    "actuators": lambda: parts.kinds(actuators.KINDS),
    "specimens": lambda: parts.kinds(specimens.KINDS),
    "couplings": lambda: parts.kinds(KINDS),
    "controllers": lambda: parts.kinds(controllers.KINDS),
    "connections": parts.connections,
    "shapes": lambda: parts.kinds(SHAPES),
    "safety limits": parts.limits,
    "effects of a specimen": lambda: effects.effects(physics.SPECIMEN),
    "effects of an actuator": lambda: effects.effects(physics.ACTUATOR),
    "effects of sensors": lambda: effects.effects(physics.SENSOR),
    "effects of a structure": lambda: effects.effects(physics.STRUCTURE),
    "effects of the ground motion": lambda: effects.effects(physics.INPUT),
    "formats of ground motions": lambda: formats.formats("ground motion"),
    "formats of measurements": lambda: formats.formats("measurement"),
    "formats that are named": formats.named,
    "criteria of the league": league.criteria,
    "league": league.league,
    "figures of another program": league.other_program,
    "routes": routes.routes,
    "commands": commands.commands,
    "options": commands.options,
    "settings": settings.settings,
    "decisions": decisions.decisions,
    "rooms of the engine": lambda: rooms.rooms("rths_engine"),
    "rooms of the parts": lambda: rooms.rooms("rths_engine.parts"),
    "rooms of the service": lambda: rooms.rooms("app"),
}
