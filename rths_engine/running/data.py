"""The data of a run as the compiled loop gets them, and the memory of a station between controller steps."""

from __future__ import annotations

from typing import Any, NamedTuple

from rths_engine.parts.structures.assembled import Members
from rths_engine.results.channels import RECORDED
from rths_engine.running.oscillation import SIZE
from rths_engine.running.yield_points import PointStates, YieldPoints

# memory of a station between substeps
X_CMD, X_MEAS, F_TRUE, F_MEAS, AREA, AREA_TURNED, TI, ENERGY_ERROR, X_TRUE, V_TRUE, X_SENT, X_END, WAVES = range(13)
MEMORY = WAVES + SIZE  # the last ones are oscillation.half_waves'
WIDTH = len(RECORDED)  # columns of every station; the current of a controller follows them
# parts of a station
COMPENSATOR, ACTUATOR, SPECIMEN, CONTROLLER = range(4)


class Setup(NamedTuple):
    """The constant data of a run (SI). S stations, Q substeps of the whole run."""

    n: int  # substeps of an integration step
    dt_step: float  # integration step
    dt: float  # substep
    factor: Any  # the integrator's D factorised
    held: Any  # its E, compressed rows
    weight: float  # its w
    shift: float  # its s
    damping: Any  # C, compressed rows
    elastic: Any  # stiffness beside the members, compressed rows
    members: Members
    points: YieldPoints  # of a condensed frame; without any, the members yield
    loads: Any  # (I, DOF), forces by a unit of each input: -M @ iota for the ground acceleration
    inputs: Any  # (steps + 1, I) at the integration steps
    floors: Any  # DOF of the floors
    drifts: Any  # L (S, DOF)
    drive: Any  # (steps + 1, S), added to L x
    dampers: Any  # number of equal dampers that a station represents (S)
    codes: Any  # part codes (S, 4)
    parameters: Any  # (4, S, widest)
    limits: Any  # (S, 4), in the order of safety.LIMITS
    noise: Any  # (Q, S, 2)
    temperatures: Any  # of the specimens, K (S)
    columns: Any  # first and last column + 1 of the stations in a row of signals (S, 2)
    kept: Any  # number of each degree of freedom among those of the model (DOF)


class State(NamedTuple):
    """The data that change from step to step, in place."""

    x: Any  # (DOF)
    v: Any  # (DOF)
    carry: Any  # c of the scheme (DOF)
    plastic: Any  # plastic curvature (members, 3)
    points: PointStates
    parts: Any  # (4, S, widest)
    memory: Any  # (S, MEMORY)


class LeftOut(NamedTuple):
    """The left-out effects of a plan. A plan without effects has a loop that is compiled without them."""

    stations: Any  # dispatch.Effects, stacked
    storeys: Any  # dispatch.Effects, stacked, E effects of storeys
    drifts: Any  # (E, DOF), maps x to the drift that each effect acts against
    stiffness: Any  # (E), elastic, along that drift


class Record(NamedTuple):
    """The output of a run. Columns of signals: inputs, floors, stations; trip: station from 0, value, bound, substep from 1."""

    signals: Any  # (Q, inputs + floors + columns of the stations)
    history: Any  # (steps + 1, 2, floors), x and v
    trip: Any  # (4)
