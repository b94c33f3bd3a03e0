"""What diagnoses make of motion: hidden by noise, between samples, misread by its sensor, of a drive in open loop."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from rths_engine.diagnosis.components import ClockSkew, Specimen, SpecimenData, StepError
from rths_engine.diagnosis.verdict import diagnose
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.velocity_drive import VelocityDrive
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.planning.shapes import BandNoise
from rths_engine.recordings.excitation.smoother import Smoother
from rths_engine.recordings.measured import Measured, MeasuredChannel
from rths_engine.running import replay

RATE, DURATION = 512.0, 14.0
DT = 1 / RATE
TIME = np.arange(int(DURATION * RATE)) * DT
SPECIMEN = LinearSpecimen(stiffness=2.0e6, damping=3.0e5)


def moved(time: Array, seed: int = 5) -> Array:
    found: Array = 0.04 * BandNoise(low_frequency=0.1, high_frequency=2.0, duration=DURATION, seed=seed).sample(time)
    return found


def plan(actuator: Part) -> Plan:
    rig = {
        "compensator": {"kind": "none"},
        "actuator": actuator.model_dump(),
        "specimen": SPECIMEN.model_dump(),
        "limits": {"displacement": 1.0, "velocity": 0.5},
    }
    drive = {"amplitude": 0.02, "shape": {"kind": "sine"}}
    return read_plan({"test": "actuator", "stations": [rig], "controller_rate": RATE, "drive": drive, "duration": DURATION})


def measured(**channels: Array) -> Measured:
    units = {"x_comp": "m", "x_meas": "m", "f_meas": "N"}
    return Measured(DT, tuple(MeasuredChannel(role, 1, values, units[role]) for role, values in channels.items()))


@pytest.mark.parametrize("sigma", [5e-6, 2e-5])
def test_the_noise_of_a_displacement_is_told_to_a_few_percent(sigma: float) -> None:
    read = moved(TIME) + sigma * np.random.default_rng(1).standard_normal(len(TIME))
    assert Smoother.of(read, DT).noise == pytest.approx(sigma, rel=0.05)


def test_finer_steps_tell_what_the_replay_of_a_smooth_motion_is_off_by() -> None:
    """Beside the force of steps a sixty-fourth as long."""
    part = MrDamper(yield_force=1.4e5, rate_coefficient=1.6e5, rate_exponent=0.46, stiffness=5e7, damping=1e7)
    n = 64
    fine = moved(np.arange(len(TIME) * n) * DT / n)
    force = replay.specimen(part, [], fine, np.ones(len(fine)), DT / n)[::n]
    specimen = Specimen("specimen:1", (part, ClockSkew(), StepError()))
    data = SpecimenData(DT, 0.0, False, fine[::n], force, np.ones(len(TIME)))
    data.__dict__["smooth"] = data.x
    plain = data.measured - specimen.predicted(specimen.base, data)
    specimen.settle(specimen.base, [data])
    settled = data.measured - specimen.predicted(specimen.base, data)
    inside = slice(40, -40)
    assert np.std(settled[:, inside]) < 0.2 * np.std(plain[:, inside])


def test_a_specimen_is_not_blamed_for_what_the_displacement_sensor_misreads() -> None:
    random, actuator = np.random.default_rng(2), FirstOrderDelay(alpha=6)
    command = moved(TIME)
    x = replay.actuator(actuator, [], command, np.zeros(len(TIME)), DT)
    v = CubicSpline(TIME, x).derivative()(TIME)
    force = SPECIMEN.stiffness * x + SPECIMEN.damping * v
    read = np.clip(x, -0.8 * np.max(np.abs(x)), 0.8 * np.max(np.abs(x))) + 1e-5 * random.standard_normal(len(x))
    noisy = force + 0.01 * np.std(force) * random.standard_normal(len(x))
    found = diagnose(plan(actuator), measured(x_comp=command, x_meas=read, f_meas=noisy)).verdict
    assert [(one.component, one.id) for one in found.effects] == [("sensor:x_meas.1", "clipping")]


def test_where_an_open_loop_drive_begins_and_how_it_creeps_says_nothing() -> None:
    random, drive = np.random.default_rng(3), VelocityDrive(gain=0.5, time_constant=0.05, velocity_limit=5.0)
    volts = 10 * moved(TIME)
    x = replay.actuator(drive, [], volts, np.zeros(len(TIME)), DT)
    read = 0.01 + 0.002 * TIME + x + 1e-5 * random.standard_normal(len(x))
    found = diagnose(plan(drive), measured(x_comp=volts, x_meas=read)).verdict
    assert found.verdict in ("consistent", "recalibrate")
