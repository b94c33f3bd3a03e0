"""`python -m rths_engine.running.warm`: compile everything once, so that the first test and the first import do not wait."""

from __future__ import annotations

import numpy as np

from rths_engine.formats.numeric_block import Layout, read_block
from rths_engine.formats.source import Source
from rths_engine.parts.connections.generic_client import GenericClient
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.parts.integrators.kr_alpha import KrAlphaIntegrator
from rths_engine.parts.physics.actuator.dead_band import DeadBand
from rths_engine.parts.physics.specimen.asymmetry import Asymmetry
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.structure.coulomb_friction import CoulombFriction
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan
from rths_engine.running import replay
from rths_engine.running.client_run import ClientRun
from rths_engine.running.external import ExternalRun
from rths_engine.running.run import simulate
from rths_engine.running.stop import stop


def warm() -> None:
    """Run one integration step of a small plan, without and with an effect and coupled, every replay and a ramp; read a row."""
    plan = templates.template("linear-damper").model_copy(update={"duration": 0.01})
    simulate(plan)
    simulate(templates.template("table3-02").model_copy(update={"duration": 0.01}))  # a frame that can yield
    station = plan.stations[0].model_copy(update={"specimen_physics": (Asymmetry(),)})
    simulate(plan.model_copy(update={"stations": (station,)}))
    followed = ClientRun(Plan(test="client", stations=plan.stations, duration=1.0))
    followed.ramp((0.0,), 1)
    followed.advance(1)
    connected = plan.stations[0].model_copy(update={"connection": GenericClient()})
    ExternalRun(plan.model_copy(update={"stations": (connected,)}), MotionLibrary(None)).rehearse()
    simulate(templates.template("two-actuators").model_copy(update={"duration": 0.01}))
    still = np.zeros(2)
    for specimen_effects in ((Asymmetry(),), (Backlash(),)):
        replay.specimen(station.specimen, specimen_effects, still, np.ones(2), plan.substep)
    for actuator_effects in ((), (DeadBand(),)):
        replay.actuator(station.actuator, actuator_effects, still, still, plan.substep)
    replay.compensator(station.compensator, still, still, plan.substep)
    for integrator in (plan.integrator, KrAlphaIntegrator(dt=plan.step)):  # a small structure's own loop, and the general one
        for structure_effects in ((), (CoulombFriction(),)):
            changed = plan.model_copy(update={"integrator": integrator, "structure_physics": structure_effects})
            replay.structure(changed, np.zeros((2, 1)), np.zeros((2, 1)))
    stop(still, 0.5)
    read_block(Source("row.csv", content=b"0,1\n"), 0, Layout(",", ".", (True, True)), lambda at, line: None)


if __name__ == "__main__":
    warm()
