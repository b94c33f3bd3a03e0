"""The unit that a model description gives a variable, compared with the unit of a plan."""

from __future__ import annotations

import math
from typing import Any

from rths_engine.foundation import units

# of the base units, by definition of the SI
EXPONENTS = {"length": {"m": 1}, "force": {"kg": 1, "m": 1, "s": -2}, "current": {"A": 1}}
BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


def contradiction(variable: Any, described: Any, unit: str) -> str | None:
    """Why the unit of a variable is not `unit`; None where they agree, and where the model description gives no unit.

    The base unit of a unit definition decides, and without it the name of the unit. A display unit has no meaning here: the
    values that an FMU exchanges are in its unit.
    """
    declared = variable.declaredType
    name = variable.unit or (declared.unit if declared is not None else None)
    if not name:
        return None
    base = next((one.baseUnit for one in described.unitDefinitions or () if one.name == name), None)
    if base is not None:
        exponents = {one: value for one in BASES if (value := int(getattr(base, one) or 0))}
        factor = float(base.factor if base.factor is not None else 1.0)
        offset = float(base.offset or 0.0)
        if (
            exponents == EXPONENTS[units.dimension(unit)]
            and not offset
            and math.isclose(factor, units.factor(unit), rel_tol=1e-6)
        ):
            return None
        written = " ".join(f"{one}^{value}" if value != 1 else one for one, value in exponents.items()) or "1"
        return f"is in {name} ({factor:g} {written}), but the plan gives {unit}"
    known = units.named(name)
    if known is not None and units.dimension(known) == units.dimension(unit) and units.factor(known) == units.factor(unit):
        return None
    return f"is in {name}, but the plan gives {unit}"
