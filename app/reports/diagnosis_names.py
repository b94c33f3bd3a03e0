"""Names for people of the components and effects of a verdict: no identifier of the JSON is shown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rths_engine.parts import physics
from rths_engine.results.channels import CHANNELS

_SENSOR = re.compile(r"\bsensor ([a-z]+_[a-z]+\.\d+)")
ALONE = "The planned model without a left-out effect"
SENSORS = {"x_meas": "displacement sensor", "f_meas": "load cell"}
ENDINGS = (" of a storey", " of the actuator", " of the displacement sensor", " of the load cell", " of the ground motion")


@dataclass(frozen=True, slots=True)
class Names:
    """The names of one plan: `specimen:1` is the "specimen of Damper, storey 1".

    `stations` are the names of the stations, in a hybrid test with their storeys.
    """

    stations: tuple[str, ...]

    @classmethod
    def of(cls, plan: Mapping[str, Any]) -> Names:
        """The names of a plan in JSON form."""
        storeys = plan.get("test", "hybrid") == "hybrid"
        return cls(tuple(_station(one, storeys) for one in plan.get("stations", ())))

    def component(self, name: str) -> str:
        """The name of a component: `specimen:1`, `sensor:x_meas.1`, `structure:2`, `input`."""
        kind, _, number = name.partition(":")
        if kind == "sensor":
            role, _, station = number.partition(".")
            sensor = SENSORS.get(role) or f"sensor of the {CHANNELS[role].label.lower() if role in CHANNELS else role}"
            return f"{sensor} of {self._at(station)}"
        if kind == "structure":
            return f"storey {number} of the structure" if number else "structure"
        if kind == "input":
            return "ground motion"
        return f"{kind} of {self._at(number)}" if number else kind

    def title(self, component: str, effect: str) -> str:
        """The name of an effect and of its place: "Backlash (specimen of Damper)"."""
        return f"{_title(component, effect)} ({self.component(component)})"

    def effects(self, effects: Sequence[str]) -> str:
        """The names of the effects of a candidate, each written component/id. Effects of one component share its name."""
        places: dict[str, list[str]] = {}
        for one in effects:
            component, _, effect = one.partition("/")
            places.setdefault(component, []).append(_title(component, effect))
        return _joined(f"{_joined(titles)} ({self.component(place)})" for place, titles in places.items()) or ALONE

    def candidate(self, written: str) -> str:
        """The name of a candidate that is written as a list of effects, separated by commas."""
        return self.effects(written.split(", ") if written else [])

    def sentence(self, text: str) -> str:
        """A sentence of a verdict with the names of the sensors that it mentions: "sensor f_meas.1" is the load cell."""
        return _SENSOR.sub(lambda found: self.component(f"sensor:{found[1]}"), text)

    def _at(self, number: str) -> str:
        place = int(number) - 1 if number.isdigit() else -1
        return self.stations[place] if 0 <= place < len(self.stations) else f"station {number}"


def capital(text: str) -> str:
    """The text with a capital first letter."""
    return text[:1].upper() + text[1:]


def _station(station: Mapping[str, Any], storeys: bool) -> str:
    return f"{station['name']}, storey {station.get('storey', 1)}" if storeys else str(station["name"])


def _title(component: str, effect: str) -> str:
    kind, _, channel = component.partition(":")
    role = channel.partition(".")[0] if kind == "sensor" else None
    known = TITLES.get((kind, role, effect))
    if known is None:
        return capital(effect.replace("_", " "))
    return next((known.removesuffix(ending) for ending in ENDINGS if known.endswith(ending)), known)


def _joined(words: Iterable[str]) -> str:
    return " and ".join(words)


def _titles() -> dict[tuple[str, str | None, str], str]:
    """(kind of component, channel of a sensor, id of the effect) -> title of the effect."""
    rooms = {
        "specimen": physics.SPECIMEN,
        "actuator": physics.ACTUATOR,
        "sensor": physics.SENSOR,
        "structure": physics.STRUCTURE,
        "input": physics.INPUT,
    }
    found = {}
    for room, kinds in rooms.items():
        for kind in kinds:
            fields = kind.model_fields
            role = str(fields["channel"].default) if "channel" in fields else None
            found[room, role, str(fields["kind"].default)] = kind.title
    return found


TITLES = _titles()
