"""A rig: commands -> actuator -> displacement -> specimen -> force, between controller ticks by classical Runge-Kutta.

Actuators: T y' = d - y with the command d of a tick held up to the tick, which is Chen and Ricles' (5a) with
1/alpha = 1 - exp(-dt / T); or y'' + 2 zeta omega y' + omega^2 (y - d(t - T_d)) = 0 with d linear between ticks. The computer of
the loop: CR integration (Chen and Ricles 2008), ramp (8), compensation (7a, 7b) and tracking indicator (9) of Chen and Ricles
(2012), EESD 41, 549-569. A rig is a vector of NUMBERS, zero where an effect is absent.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from tests.proof.generator.motion import Array

PARTS = 12  # substeps of a tick
NUMBERS = (
    *("order", "time_constant", "omega", "zeta", "dead_time", "speed"),
    *("delay", "slope", "memory", "lag", "lag_zeta", "band", "flexibility", "yielding_time"),
    *("play", "stick", "catching", "gain", "uneven", "rate_gain", "hysteresis", "hysteresis_width", "wander", "wander_rate"),
    *("stall", "sustained", "emptying"),
    *("law", "a", "b", "n", "k", "c", "x_0", "v_0"),
    *("fade", "drop", "drop_time", "asymmetry", "exponent", "reference", "spring", "cubic"),
    *("friction", "presliding", "static", "stribeck", "strength", "x_y", "sharpness", "fullness", "depth", "width"),
)
AT = {name: place for place, name in enumerate(NUMBERS)}
# fmt: off
(
    ORDER, TIME, OMEGA, ZETA, DEAD, SPEED, DELAY, SLOPE, MEMORY, LAG, LAG_ZETA, BAND, FLEXIBILITY, YIELDING,
    PLAY, STICK, CATCHING, GAIN, UNEVEN, RATE_GAIN, HYSTERESIS, HYSTERESIS_WIDTH, WANDER, WANDER_RATE, STALL,
    SUSTAINED, EMPTYING,
    LAW, A, B, N, K, C, X_0, V_0, FADE, DROP, DROP_TIME, ASYMMETRY, EXPONENT, REFERENCE, SPRING, CUBIC, FRICTION, PRESLIDING,
    STATIC, STRIBECK, STRENGTH, X_Y, SHARPNESS, FULLNESS, DEPTH, WIDTH,
) = range(len(NUMBERS))
# fmt: on
LINEAR, SLIDER_MAXWELL, TANGENT = range(3)
# state of the actuator: drive, its rate, deflection, piston, stuck, offset, way, memory of amplitude, hysteresis
Y, Y_RATE, DEFLECTED, PISTON, STUCK, OFFSET, WAY, AMPLITUDE, BENT, LAGGING, LAG_RATE, LOAD, DRAWN, STATES = range(14)
# state of the specimen: Maxwell force, energy, friction, Bouc-Wen, then its place of the last two ticks and its speed
MAXWELL, ENERGY, BRISTLE, ZETA_BW, LAST, EARLIER, LAST_SPEED, SPECIMEN_STATES = range(8)


def rig(**numbers: float) -> Array:
    """The parameters of a rig as one vector."""
    made = np.zeros(len(NUMBERS))
    made[[AT["memory"], AT["yielding_time"], AT["catching"], AT["reference"]]] = 2.0, 0.005, 0.02, 0.1
    made[[AT["presliding"], AT["stribeck"], AT["x_y"], AT["sharpness"], AT["width"], AT["hysteresis_width"]]] = 1.0
    for name, value in numbers.items():
        made[AT[name]] = value
    return made


def driven(numbers: Array, commands: Array, step: float) -> tuple[Array, Array]:
    """Displacement (m) and force (N) at every tick from the commands (m)."""
    displacement, force = _driven(numbers, commands, step)
    return displacement, force


@njit(cache=True)
def _driven(p, commands, dt):  # type: ignore[no-untyped-def]
    count = commands.size
    x, f = np.zeros(count), np.zeros(count)
    s, m = np.zeros(STATES), np.zeros(SPECIMEN_STATES)
    sent, force, last = np.zeros(count), 0.0, 0.0
    for q in range(count):
        x[q], force, last = _tick(p, s, m, commands, sent, q, force, last, dt)
        f[q] = force
    return x, f


@njit(cache=True)
def _late(signal, q, late):  # type: ignore[no-untyped-def]
    whole = math.floor(late)
    share = late - whole
    near = signal[max(q - int(whole), 0)]
    far = signal[max(q - int(whole) - 1, 0)]
    return near + share * (far - near)


@njit(cache=True)
def _tick(p, s, m, commands, sent, q, force, last, dt):  # type: ignore[no-untyped-def]
    """One tick: the piston, the force and the command that reached the actuator."""
    s[AMPLITUDE] = max(abs(commands[q]), s[AMPLITUDE] * math.exp(-dt / p[MEMORY]))
    late = p[DELAY] + min(p[SLOPE] * s[AMPLITUDE], 0.1)
    sent[q] = (
        _late(commands, q, late / dt) if late >= 0.0 else commands[q] - late * (commands[q] - commands[max(q - 1, 0)]) / dt
    )
    h = dt / PARTS
    s[LOAD] = force
    if p[LAG] > 0.0:
        before = sent[max(q - 1, 0)] if q > 0 else sent[q]
        # the command as it came to the lag is kept in s by its own last value: linear over the tick
        _lagged(p, s, last if q > 0 else before, sent[q], dt)
        last = sent[q]
        sent[q] = s[LAGGING]
    for part in range(PARTS):
        t = q * dt - dt + (part + 1) * h
        _drive(p, s, sent, q, part / PARTS, h, dt, t)
        s[DEFLECTED] += (1.0 - math.exp(-h / p[YIELDING])) * (p[FLEXIBILITY] * force - s[DEFLECTED])
        before = s[PISTON]
        s[PISTON] = _piston(p, s, h)
        s[DRAWN] = max(s[DRAWN] + abs(s[PISTON] - before) - p[SUSTAINED] * h, 0.0)
    return s[PISTON], _moved(p, m, s[PISTON], q * dt - dt, dt), last


@njit(cache=True)
def _moved(p, m, x, t, dt):  # type: ignore[no-untyped-def]
    """The force at the end of a tick. Between ticks the piston moves by Hermite's cubic with the speeds of parabolas through
    three ticks: the oil smooths the steps of the command, which displacements read at ticks do not show."""
    h, before, speed = dt / PARTS, m[LAST], m[LAST_SPEED]
    now = (3.0 * x - 4.0 * before + m[EARLIER]) / (2.0 * dt)
    curved = 3.0 * (x - before) / dt - 2.0 * speed - now  # of the cubic over u from 0 to 1
    twisted = speed + now - 2.0 * (x - before) / dt
    force, low = 0.0, speed
    for part in range(PARTS):
        u, middle = (part + 1) / PARTS, (part + 0.5) / PARTS
        half, high = speed + 2.0 * curved * middle + 3.0 * twisted * middle**2, speed + 2.0 * curved * u + 3.0 * twisted * u**2
        place = before + dt * u * (speed + u * (curved + u * twisted))
        force = _specimen(p, m, place, low, half, high, t + dt * u, h)
        low = high
    m[EARLIER], m[LAST], m[LAST_SPEED] = before, x, now
    return force


@njit(cache=True)
def _lagged(p, s, before, now, dt):  # type: ignore[no-untyped-def]
    """T^2 l'' + 2 zeta T l' + l = d over a tick, d linear."""
    h = dt / PARTS
    for part in range(PARTS):
        low, high = before + (now - before) * part / PARTS, before + (now - before) * (part + 1) / PARTS
        y, v = s[LAGGING], s[LAG_RATE]
        k1, a1 = v, (low - y - 2.0 * p[LAG_ZETA] * p[LAG] * v) / p[LAG] ** 2
        middle = 0.5 * (low + high)
        v2 = v + 0.5 * h * a1
        a2 = (middle - (y + 0.5 * h * k1) - 2.0 * p[LAG_ZETA] * p[LAG] * v2) / p[LAG] ** 2
        v3 = v + 0.5 * h * a2
        a3 = (middle - (y + 0.5 * h * v2) - 2.0 * p[LAG_ZETA] * p[LAG] * v3) / p[LAG] ** 2
        v4 = v + h * a3
        a4 = (high - (y + h * v3) - 2.0 * p[LAG_ZETA] * p[LAG] * v4) / p[LAG] ** 2
        s[LAGGING] = y + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
        s[LAG_RATE] = v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)


@njit(cache=True)
def _asked(p, s, d, y):  # type: ignore[no-untyped-def]
    error = d - y
    if p[EMPTYING] > 0.0:  # the supply that the drawn way leaves
        return error * math.sqrt(max(1.0 - p[EMPTYING] * s[DRAWN], 0.0))
    if p[STALL] > 0.0:  # the flow of an orifice: the root of the pressure that the load leaves
        return error * math.sqrt(max(1.0 - math.copysign(s[LOAD] / p[STALL], s[LOAD] * error), 0.0))
    if abs(error) <= p[BAND]:
        return 0.0
    return error - p[BAND] if error > 0.0 else error + p[BAND]


@njit(cache=True)
def _rate(p, s, d, y, t):  # type: ignore[no-untyped-def]
    error = _asked(p, s, d, y)
    constant = p[TIME] * (1.0 + p[WANDER] * math.sin(2.0 * math.pi * p[WANDER_RATE] * t))
    if error < 0.0:
        constant *= 1.0 + p[UNEVEN]
    return min(max(error / constant, -p[SPEED]), p[SPEED])


@njit(cache=True)
def _drive(p, s, sent, q, share, h, dt, t):  # type: ignore[no-untyped-def]
    y = s[Y]
    if p[ORDER] == 1.0:
        d = sent[q]
        k1 = _rate(p, s, d, y, t)
        k2 = _rate(p, s, d, y + 0.5 * h * k1, t)
        k3 = _rate(p, s, d, y + 0.5 * h * k2, t)
        k4 = _rate(p, s, d, y + h * k3, t)
        s[Y] = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        s[Y_RATE] = (s[Y] - y) / h
        return
    late, w = p[DEAD] / dt, p[OMEGA]
    d1 = _late(sent, q, late + 1.0 - share)
    d2 = _late(sent, q, late + 1.0 - share - 0.5 / PARTS)
    d3 = _late(sent, q, late + 1.0 - share - 1.0 / PARTS)
    v = s[Y_RATE]
    a1 = w * w * _asked(p, s, d1, y) - 2.0 * p[ZETA] * w * v
    v2 = v + 0.5 * h * a1
    a2 = w * w * _asked(p, s, d2, y + 0.5 * h * v) - 2.0 * p[ZETA] * w * v2
    v3 = v + 0.5 * h * a2
    a3 = w * w * _asked(p, s, d2, y + 0.5 * h * v2) - 2.0 * p[ZETA] * w * v3
    v4 = v + h * a3
    a4 = w * w * _asked(p, s, d3, y + h * v3) - 2.0 * p[ZETA] * w * v4
    move = h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
    s[Y_RATE] = v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    if abs(move) > p[SPEED] * h:
        move = math.copysign(p[SPEED] * h, move)
        s[Y_RATE] = move / h
    s[Y] = y + move


@njit(cache=True)
def _piston(p, s, h):  # type: ignore[no-untyped-def]
    """The displacement of the piston from the drive: hysteresis, gain, backlash, stick friction and deflection."""
    y = s[Y] * (1.0 + p[GAIN] - p[RATE_GAIN] * abs(s[Y_RATE]))
    if p[HYSTERESIS] > 0.0:
        v, z = s[Y_RATE], s[BENT]
        s[BENT] = min(max(z + h * (v - 0.5 * abs(v) * z - 0.5 * v * abs(z)) / p[HYSTERESIS_WIDTH], -1.0), 1.0)
        y -= p[HYSTERESIS] * s[BENT]
    if p[PLAY] > 0.0:
        return min(max(s[PISTON], y - p[PLAY]), y + p[PLAY])
    if p[STICK] > 0.0:
        if s[Y_RATE] * s[WAY] < 0.0:
            s[STUCK] = 1.0
        if s[Y_RATE] != 0.0:
            s[WAY] = math.copysign(1.0, s[Y_RATE])
        ahead = y - s[PISTON]
        if s[STUCK] > 0.0:
            if abs(ahead) < p[STICK]:
                return s[PISTON]
            s[STUCK], s[OFFSET] = 0.0, -math.copysign(p[STICK], ahead)
        s[OFFSET] *= math.exp(-h / p[CATCHING])
        return y + s[OFFSET]
    return y - s[DEFLECTED]


@njit(cache=True)
def _maxwell_rate(p, f, v):  # type: ignore[no-untyped-def]
    excess = abs(f) - p[A]
    slip = (excess / p[B]) ** (1.0 / p[N]) if excess > 0.0 else 0.0
    return p[K] * (v - f / p[C] - math.copysign(slip, f))


@njit(cache=True)
def _specimen(p, m, x, low, middle, v, t, h):  # type: ignore[no-untyped-def]
    """The force at x after a move over h with the speeds `low`, `middle` and v at its start, middle and end."""
    if p[LAW] == SLIDER_MAXWELL:
        f = m[MAXWELL]
        k1 = _maxwell_rate(p, f, low)
        k2 = _maxwell_rate(p, f + 0.5 * h * k1, middle)
        k3 = _maxwell_rate(p, f + 0.5 * h * k2, middle)
        k4 = _maxwell_rate(p, f + h * k3, v)
        m[MAXWELL] = f = f + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    elif p[LAW] == TANGENT:
        f = p[K] * x + p[C] * v + p[A] * math.tanh(v / p[V_0] + x / p[X_0])
    else:
        f = p[K] * x + p[C] * v
    f += p[SPRING] * x + p[CUBIC] * x**3
    if p[EXPONENT] != 0.0:
        f *= math.hypot(v / p[REFERENCE], 0.05) ** p[EXPONENT]
    f *= 1.0 + p[ASYMMETRY] * math.copysign(1.0, f)
    f *= 1.0 - p[DEPTH] * math.exp(-((x / p[WIDTH]) ** 2))
    if p[FRICTION] > 0.0:
        most = 1.0 + max(p[STATIC] / p[FRICTION] - 1.0, 0.0) * math.exp(-((v / p[STRIBECK]) ** 2))
        ends = math.copysign(most, middle)
        m[BRISTLE] = (
            ends + (m[BRISTLE] - ends) * math.exp(-abs(middle) * h / (most * p[PRESLIDING])) if middle != 0.0 else m[BRISTLE]
        )
        f += p[FRICTION] * m[BRISTLE]
    if p[STRENGTH] > 0.0:
        z = m[ZETA_BW]
        turned = p[FULLNESS] * math.copysign(1.0, v * z) + 1.0 - p[FULLNESS]
        between = z + 0.5 * h * v / p[X_Y] * (1.0 - turned * abs(z) ** p[SHARPNESS])
        turned = p[FULLNESS] * math.copysign(1.0, v * between) + 1.0 - p[FULLNESS]
        m[ZETA_BW] = z + h * v / p[X_Y] * (1.0 - turned * abs(between) ** p[SHARPNESS])
        f += p[STRENGTH] * m[ZETA_BW]
    if p[DROP] > 0.0 and t > p[DROP_TIME]:
        f *= 1.0 - p[DROP]
    f *= max(1.0 - p[FADE] * m[ENERGY], 0.05)
    m[ENERGY] += h * f * middle
    return f


@njit(cache=True)
def closed(p, mass, damping, stiffness, effective, drift, ground, x_noise, f_noise, n, dt, compensator):  # type: ignore[no-untyped-def]
    """The loop over len(ground) - 1 integration steps of n ticks. compensator: alpha_es, k_p, k_i; alpha_es = 1: none.

    Columns: x_cmd, x_comp, x_meas, f_meas, x, f (the last two without noise).
    """
    steps, count = ground.size - 1, mass.shape[0]
    total, step = steps * n, n * dt
    found, commands, sent = np.zeros((total, 6)), np.zeros(total), np.zeros(total)
    x, v = np.zeros(count), np.zeros(count)
    s, m = np.zeros(STATES), np.zeros(SPECIMEN_STATES)
    force, lag_last, f_meas, cmd_last, meas_last = 0.0, 0.0, 0.0, 0.0, 0.0
    area, turned, indicator, before, integral = 0.0, 0.0, 0.0, 0.0, 0.0
    iota = np.ones(count)
    inverse = np.linalg.inv(effective)
    for i in range(steps):
        residual = -(mass @ iota) * ground[i] - damping @ v - stiffness @ x - drift * f_meas
        v = v + step * (inverse @ residual)
        x_next = x + step * v
        start, end = drift @ x, drift @ x_next
        for k in range(1, n + 1):
            q = i * n + k - 1
            x_cmd = start + k / n * (end - start)
            integral += 0.5 * (indicator + before) * dt
            before = indicator
            alpha = compensator[0] + compensator[1] * indicator + compensator[2] * integral
            commands[q] = alpha * x_cmd - (alpha - 1.0) * cmd_last
            true, force, lag_last = _tick(p, s, m, commands, sent, q, force, lag_last, dt)
            x_meas, f_meas = true + x_noise[q], force + f_noise[q]
            area += 0.5 * (x_cmd + cmd_last) * (x_meas - meas_last)
            turned += 0.5 * (x_meas + meas_last) * (x_cmd - cmd_last)
            indicator = 0.5 * (area - turned)
            cmd_last, meas_last = x_cmd, x_meas
            found[q, 0], found[q, 1], found[q, 2], found[q, 3], found[q, 4], found[q, 5] = (
                x_cmd,
                commands[q],
                x_meas,
                f_meas,
                true,
                force,
            )
        x = x_next
    return found
