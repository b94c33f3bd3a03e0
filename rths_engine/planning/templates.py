"""Templates of plans: the twelve simulations of Table III of Chen and Ricles (2012), examples, and a published benchmark."""

from __future__ import annotations

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning import laboratory, vrths
from rths_engine.planning.examples import EXAMPLES
from rths_engine.planning.paper import PAPER
from rths_engine.planning.plan import Plan
from rths_engine.planning.vrths import VRTHS

TABLE3 = "Chen and Ricles (2012), Table III"
BENCHMARK = "Virtual RTHS benchmark, Silva et al. (2020)"
GROUPS = {
    "hybrid": "Hybrid tests",
    "specimen": "Tests of a specimen",
    "actuator": "Tests of an actuator",
    "structure": "Tests of a structure alone",
    "client": "Tests with a client",
}


def names() -> list[str]:
    """Names of all templates."""
    return [*PAPER, *EXAMPLES, *VRTHS]


def group(name: str) -> str:
    """The heading under which a template is listed."""
    if name in VRTHS:
        return BENCHMARK
    return TABLE3 if name in PAPER else GROUPS[template(name).test]


def template(name: str) -> Plan:
    """The plan named `name`. Raises PlanError with the names of all templates."""
    if name in PAPER:
        return laboratory.plan(PAPER[name], laboratory.BUNDLED)
    if name in EXAMPLES:
        return EXAMPLES[name](name)
    if name in VRTHS:
        return vrths.template(VRTHS[name])
    raise PlanError(Issue("", f"the template '{name}' does not exist", fix="choose one of " + ", ".join(names())))
