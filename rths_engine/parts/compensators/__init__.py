"""Delay compensators: `step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt) -> x_comp`, all in m, m^2 and s.

`x_meas` and `ti` are the values of the last substep. s[0] is recorded as d_alpha.
"""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.amb import AdaptiveModelBased
from rths_engine.parts.compensators.ats import AdaptiveTimeSeries
from rths_engine.parts.compensators.derivative import DerivativeFeedForward
from rths_engine.parts.compensators.dual import DualCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.compensators.kalman import KalmanPredictor
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.compensators.phase_lead import PhaseLead
from rths_engine.parts.compensators.pi_phase_lead import PiPhaseLead
from rths_engine.parts.compensators.polynomial import PolynomialExtrapolation
from rths_engine.parts.compensators.robust import RobustIntegratedControl
from rths_engine.parts.compensators.two_stage import TwoStageAdaptive

Compensator = Annotated[
    NoCompensation
    | InverseCompensation
    | AdaptiveInverseCompensation
    | DualCompensation
    | PolynomialExtrapolation
    | DerivativeFeedForward
    | PhaseLead
    | AdaptiveTimeSeries
    | AdaptiveModelBased
    | TwoStageAdaptive
    | KalmanPredictor
    | RobustIntegratedControl
    | PiPhaseLead,
    Field(discriminator="kind"),
]
KINDS = kinds(Compensator)
