"""The terms of measures and channels, and further terms that people meet on pages and in reports, each in one line."""

from __future__ import annotations

from typing import NamedTuple

from rths_engine.foundation import units
from rths_engine.results.channels import CHANNELS
from rths_engine.results.measures import MEASURES


class Term(NamedTuple):
    """A term, its symbol, its unit as people read it (both may be empty), and what it means."""

    term: str
    symbol: str
    unit: str
    meaning: str


TERMS = (
    Term("Actuator delay", "α_es", "", "delay that an inverse compensator assumes, in controller steps"),
    Term("Analytical substructure", "", "", "the part of the structure that is computed"),
    Term("Damping ratio", "ζ", "%", "damping of a mode over its critical damping"),
    Term("Delay compensator", "", "", "changes the command so that the actuator arrives on time"),
    Term("Delay margin", "", "ms", "further delay at which the closed loop becomes unstable"),
    Term(
        "Experimental substructure",
        "",
        "",
        "the part of the structure that the laboratory tests",
    ),
    Term("First period", "T₁", "s", "longest natural period of the analytical substructure without damping"),
    Term("Frequency evaluation index", "FEI", "", "ratio of the transforms of d_m and d_c, weighed by the power of d_c"),
    Term("Influence vector", "iota", "", "displacement of each degree of freedom for a unit displacement of the ground"),
    Term("Matrices", "M, C, K", "", "mass, damping and stiffness matrix of the structure"),
    Term("Peak ground acceleration", "PGA", "g", "largest magnitude of the ground acceleration"),
    Term("Specimen", "", "", "the device under test, such as a damper"),
    Term("Spectral acceleration", "Sa(T₁)", "g", "response spectrum of the ground motion at the first period"),
    Term("Station", "", "", "one actuator with its specimen, sensors and safety limits"),
    Term("Substep", "", "", "one step of the controller; an integration step has one or more"),
    Term("Synchronisation subspace", "", "", "plot of d_m over d_c; a straight line at 45° is perfect tracking"),
)


def glossary() -> list[Term]:
    """All terms in alphabetical order."""
    measures = [Term(one.label, one.symbol, one.shown_label, one.meaning) for one in MEASURES]
    channels = [Term(one.label, one.symbol, units.pretty(one.shown), one.meaning) for one in CHANNELS.values()]
    return sorted([*measures, *channels, *TERMS], key=lambda term: term.term.casefold())
