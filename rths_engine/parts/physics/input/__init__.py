"""Left-out effects of the ground motion."""

from typing import TYPE_CHECKING, Any

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.input.baseline_drift import BaselineDrift, BaselineDriftSearch
from rths_engine.parts.physics.input.low_pass import LowPass, LowPassSearch
from rths_engine.parts.physics.input.scale_error import GroundScaleError, GroundScaleErrorSearch
from rths_engine.parts.physics.input.time_shift import TimeShift, TimeShiftSearch
from rths_engine.parts.physics.registry import laws, union
from rths_engine.parts.physics.search import Search

SEARCHES: tuple[Search[Any], ...] = (
    GroundScaleErrorSearch(GroundScaleError),
    TimeShiftSearch(TimeShift),
    LowPassSearch(LowPass),
    BaselineDriftSearch(BaselineDrift),
)
KINDS = laws(SEARCHES)
if TYPE_CHECKING:
    InputEffect = Effect
else:
    InputEffect = union(KINDS)
