"""Left-out effects of a sensor, each for the displacement and for the force reading."""

from typing import TYPE_CHECKING, Any

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.registry import laws, union
from rths_engine.parts.physics.search import Search
from rths_engine.parts.physics.sensor.clipping import ClippingSearch, DisplacementClipping, ForceClipping
from rths_engine.parts.physics.sensor.drift import DisplacementDrift, DriftSearch, ForceDrift
from rths_engine.parts.physics.sensor.dropout import DisplacementDropout, DropoutSearch, ForceDropout
from rths_engine.parts.physics.sensor.offset import DisplacementOffset, ForceOffset, OffsetSearch
from rths_engine.parts.physics.sensor.scale_error import DisplacementScaleError, ForceScaleError, ScaleErrorSearch
from rths_engine.parts.physics.sensor.time_skew import DisplacementTimeSkew, ForceTimeSkew, TimeSkewSearch

SEARCHES: tuple[Search[Any], ...] = (
    OffsetSearch(DisplacementOffset),
    OffsetSearch(ForceOffset),
    DriftSearch(DisplacementDrift),
    DriftSearch(ForceDrift),
    ScaleErrorSearch(DisplacementScaleError),
    ScaleErrorSearch(ForceScaleError),
    TimeSkewSearch(DisplacementTimeSkew),
    TimeSkewSearch(ForceTimeSkew),
    ClippingSearch(DisplacementClipping),
    ClippingSearch(ForceClipping),
    DropoutSearch(DisplacementDropout),
    DropoutSearch(ForceDropout),
)
KINDS = laws(SEARCHES)
if TYPE_CHECKING:
    SensorEffect = Effect
else:
    SensorEffect = union(KINDS)
