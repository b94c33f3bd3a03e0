"""Robust integrated control: feed-forward of the inverse, H-infinity feedback of the tracking error, and a Kalman filter."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, Self

import numpy as np
from scipy.linalg import expm, solve_discrete_are

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.actuator_model import ActuatorModel, fields_for
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem
from rths_engine.parts.compensators.loop_shaping import Linear, robust_controller
from rths_engine.parts.compensators.synthesis import finite, synthesis

# chosen; see docs/decisions/0023
GAMMA = 2.0  # largest gamma of settings for a transfer system
FINEST = 1e-3  # s, step of the derivatives of a smooth command
HALVINGS = 12  # of the search for a bandwidth
ORDER = 5  # states of the controller: plant 2, dead time 1, weight 1 in the synthesis and 1 behind it, by definition
ESTIMATE, CONTROL, NEXT, RING = 3, 6, 6 + ORDER, 6 + 2 * ORDER  # places in the state
MODEL, ROWS = 7, 22  # places in the parameters
INPUT, OUTPUT = ROWS + ORDER**2, ROWS + ORDER**2 + ORDER
DIRECT = OUTPUT + ORDER


class RobustIntegratedControl(Compensating):
    """Robust integrated control of the actuator (H-infinity feedback, Kalman filter and feed-forward).

    d_p = a0 d_c + a1 d_c' + a2 d_c'' + a3 d_c''' + K (d_c - y),  K = W K_inf,  y estimated from d_p and d_m

    a is the series of the inverse of the actuator's model G(s) = gain exp(-T s) / (1 + 2 zeta s / omega + s^2 / omega^2),
    T = delay - 2 zeta / omega. The feedback corrects what the model errs. K_inf is the H-infinity loop-shaping controller of
    G W (`loop_shaping`) with the weight W = k (1 + w_b / s), where |G W| = 1 at the bandwidth w_b; the dead time is a Pade
    approximation of first order and includes the step that the measurement is late. The Kalman filter estimates the measured
    displacement y from the model, driven by d_p and white noise of density rho^2 at its input, and from d_m with noise of
    density 1. On the model itself the filter does not change the loop (separation); of a lag that the model errs, it leaves a
    share that falls with rho. `build` computes all gains; the controller
    is sampled by the bilinear transformation. Derivatives are backward differences over h.
    State: s[0] unused, s[1] index in the ring, s[2] last d_p (m), then the estimate (3), controller (5) and its next value (5),
    and the ring of d_c.
    Not valid where the actuator differs from its model by more than 1 / gamma at the bandwidth: the feedback becomes unstable.
    Source: Ou, Ozdagli, Dyke and Wu (2015), "Robust integrated actuator control: experimental verification and real-time
    hybrid-simulation implementation", EESD 44, 441-460; Ning, Wang, Zhou, Wu, Ding and Xu (2019), Mech. Syst. Signal Process.
    131, 49-70.
    """

    kind: Literal["robust"] = "robust"
    gain: float = quantity("Static gain of the actuator's model", ge=0.2, le=5, default=1.0)
    delay: float = quantity("Delay τ", "s", "ms", ge=0.0005, le=0.2, default=29 / 1024)
    frequency: float = quantity("Natural frequency of the actuator's model f", "Hz", ge=0.1, le=1000, default=15.0)
    damping_ratio: float = quantity("Damping ratio of the actuator's model ζ", "1", "%", ge=0.01, le=10, default=0.9)
    bandwidth: float = quantity("Bandwidth of the feedback", "Hz", ge=0.01, le=50, default=5.0)
    trust: float = quantity(
        "Driving noise over sensor noise ρ", ge=0.001, le=1000, default=30.0, help="large: the Kalman filter follows the sensor"
    )
    derivative_step: float = quantity("Step of the derivatives h", "s", "ms", gt=0, le=0.05, default=10 / 1024)
    title: ClassVar[str] = "Robust integrated (H∞ and Kalman filter)"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The model of the system, and the largest bandwidth up to 20 Hz with gamma <= 2."""
        fields = fields_for(system)
        fields["delay"] = max(fields["delay"], 0.0005)
        step = max(system.step, system.dt, FINEST)
        narrow, wide = 0.05, 20.0
        for _ in range(HALVINGS):
            middle = math.sqrt(narrow * wide)
            _, gamma = cls(**fields, bandwidth=middle).controller(system.dt)
            narrow, wide = (middle, wide) if gamma <= GAMMA else (narrow, middle)
        return cls(**fields, bandwidth=narrow, derivative_step=step)

    def controller(self, dt: float) -> tuple[Linear, float]:
        """The feedback K in continuous time, and gamma. Raises PlanError where the synthesis has no solution."""
        with synthesis(self, dt):
            plant = _plant(ActuatorModel.of(self), dt)
            pace = 2 * math.pi * self.bandwidth
            size = 1 / (abs(plant.at(1j * pace)) * math.sqrt(2))
            weight = Linear(np.zeros((1, 1)), np.ones((1, 1)), np.array([[size * pace]]), size)
            found, gamma = robust_controller(plant.behind(weight))
            return weight.behind(found), gamma

    def build(self, dt: float) -> tuple[Array, Array]:
        spacing = max(1, round(self.derivative_step / dt))
        length = 3 * spacing + 1
        with synthesis(self, dt):
            gains = finite(self._gains(dt, spacing))
        return np.array([spacing, length, *gains]), np.zeros(RING + length)

    def _gains(self, dt: float, spacing: int) -> Array:
        model = ActuatorModel.of(self)
        a0, a1, a2, a3 = model.inverse() / (spacing * dt) ** np.arange(4.0)
        forward = [a0 + a1 + a2 + a3, -a1 - 2 * a2 - 3 * a3, a2 + 3 * a3, -a3]
        plant = _plant(model, 0.0 if model.dead_time > 0 else dt)
        held = expm(np.block([[plant.a, plant.b], [np.zeros((1, 4))]]) * dt)
        move, push = held[:3, :3], held[:3, 3:]
        spread = solve_discrete_are(move.T, plant.c.T, self.trust**2 * push @ push.T, np.eye(1))
        gain = spread @ plant.c.T / (plant.c @ spread @ plant.c.T + 1)
        feedback = self.controller(dt)[0].sampled(dt)
        estimator = [*move.ravel(), *push.ravel(), *gain.ravel()]
        control = [*feedback.a.ravel(), *feedback.b.ravel(), *feedback.c.ravel(), feedback.d]
        return np.array([model.gain, *forward, *estimator, *control])

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        spacing, length, newest = int(p[0]), int(p[1]), int(s[1])
        one, two, three = (newest - spacing) % length, (newest - 2 * spacing) % length, (newest + 1) % length
        s[1] = three
        s[RING + newest] = x_cmd
        x_comp = p[3] * x_cmd + p[4] * s[RING + one] + p[5] * s[RING + two] + p[6] * s[RING + three]
        z, v, w = s[ESTIMATE], s[ESTIMATE + 1], s[ESTIMATE + 2]
        for i in range(3):
            row = MODEL + 3 * i
            s[ESTIMATE + i] = p[row] * z + p[row + 1] * v + p[row + 2] * w + p[MODEL + 9 + i] * s[2]
        news = x_meas - p[2] * s[ESTIMATE]
        for i in range(3):
            s[ESTIMATE + i] += p[MODEL + 12 + i] * news
        error = x_cmd_last - p[2] * s[ESTIMATE]
        x_comp += p[DIRECT] * error
        for i in range(ORDER):
            x_comp += p[OUTPUT + i] * s[CONTROL + i]
            moved = p[INPUT + i] * error
            for j in range(ORDER):
                moved += p[ROWS + ORDER * i + j] * s[CONTROL + j]
            s[NEXT + i] = moved
        for i in range(ORDER):
            s[CONTROL + i] = s[NEXT + i]
        s[2] = x_comp
        return x_comp


def _plant(model: ActuatorModel, later: float) -> Linear:
    """The model with a dead time that is longer by `later` (s), as a Pade approximation of first order."""
    late = model.dead_time + later
    second = Linear(
        model.omega * np.array([[0.0, 1.0], [-1.0, -2 * model.damping_ratio]]),
        model.omega * np.array([[0.0], [1.0]]),
        np.array([[model.gain, 0.0]]),
    )
    return second.behind(Linear(np.array([[-2 / late]]), np.array([[2 / late]]), np.array([[2.0]]), -1.0))
