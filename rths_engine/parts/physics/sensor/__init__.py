"""Left-out effects of a sensor, each for either channel."""

from typing import Annotated

from pydantic import Field

from rths_engine.parts.physics.sensor.clipping import DisplacementClipping, ForceClipping
from rths_engine.parts.physics.sensor.drift import DisplacementDrift, ForceDrift
from rths_engine.parts.physics.sensor.dropout import DisplacementDropout, ForceDropout
from rths_engine.parts.physics.sensor.offset import DisplacementOffset, ForceOffset
from rths_engine.parts.physics.sensor.scale_error import DisplacementScaleError, ForceScaleError
from rths_engine.parts.physics.sensor.time_skew import DisplacementTimeSkew, ForceTimeSkew

KINDS = (
    DisplacementOffset,
    ForceOffset,
    DisplacementDrift,
    ForceDrift,
    DisplacementScaleError,
    ForceScaleError,
    DisplacementTimeSkew,
    ForceTimeSkew,
    DisplacementClipping,
    ForceClipping,
    DisplacementDropout,
    ForceDropout,
)
Offset = Annotated[DisplacementOffset | ForceOffset, Field(discriminator="channel")]
Drift = Annotated[DisplacementDrift | ForceDrift, Field(discriminator="channel")]
ScaleError = Annotated[DisplacementScaleError | ForceScaleError, Field(discriminator="channel")]
TimeSkew = Annotated[DisplacementTimeSkew | ForceTimeSkew, Field(discriminator="channel")]
Clipping = Annotated[DisplacementClipping | ForceClipping, Field(discriminator="channel")]
Dropout = Annotated[DisplacementDropout | ForceDropout, Field(discriminator="channel")]
SensorEffect = Annotated[Offset | Drift | ScaleError | TimeSkew | Clipping | Dropout, Field(discriminator="kind")]
