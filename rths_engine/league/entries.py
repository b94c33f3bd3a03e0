"""The compensators of the league: every one of the registry, with the settings of its own rule, and published designs."""

from __future__ import annotations

from dataclasses import dataclass

from rths_engine.parts import compensators
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.pi_phase_lead import PiPhaseLead
from rths_engine.planning import vrths

# published designs for this benchmark, executed here: compensator, source
PUBLISHED: tuple[tuple[Compensator, str], ...] = (
    (PiPhaseLead(), "Silva, Gomez, Maghareh, Dyke and Spencer (2020), the sample controller of the benchmark"),
)


@dataclass(frozen=True, slots=True)
class Entry:
    """A row of the league; `published` is the source of a published design, empty for settings by the compensator's rule."""

    compensator: Compensator
    published: str = ""

    @property
    def kind(self) -> str:
        return self.compensator.kind

    @property
    def title(self) -> str:
        return f"{self.compensator.title}, published design" if self.published else self.compensator.title


def entries(case: int, only: tuple[str, ...] = ()) -> tuple[Entry, ...]:
    """The entries for a case, in the order of the registry; `only` names kinds of compensators, empty means all."""
    known = vrths.known(case)
    tuned = [Entry(kind.tuned_for(known)) for kind in compensators.KINDS]
    published = [Entry(compensator, source) for compensator, source in PUBLISHED]
    return tuple(entry for entry in (*tuned, *published) if not only or entry.kind in only)
