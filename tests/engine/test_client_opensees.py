"""A stock OpenSees script drives the emulated rig through its element genericClient."""

from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rths_engine.client.session import Session
from rths_engine.planning.excitation import FloorForce
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.planning.shapes import Sine
from rths_engine.recordings.run_file import load
from rths_engine.running.run import simulate
from tests.engine.clients import led, opensees, served, station
from tests.opensees import peer

MASS, SPRING, RATIO, STEP, STEPS = 1.0e5, 4.0e6, 0.02, 0.01, 200
LOAD = FloorForce(floor=1, amplitude=5.0e4, shape=Sine(frequency=0.8, cycles=5, ramps=1))
STATION = station(
    actuator={"kind": "first_order_delay", "alpha": 12.0},
    compensator={"kind": "inverse", "alpha_es": 12.0},
    specimen={"kind": "linear", "stiffness": 2.0e6, "damping": 5.0e4},
)


@pytest.fixture(autouse=True)
def _with_opensees() -> None:
    if reason := peer.missing():
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(reason)


def script(integrator: str, algorithm: str = "'Linear'", options: str = "", steps: int = STEPS, then: str = "") -> str:
    load = LOAD.sample(np.arange(steps + 1) * STEP).tolist()
    return f"""
import sys
import openseespy.opensees as ops
ops.model('basic', '-ndm', 1, '-ndf', 1)
ops.node(1, 0.0)
ops.node(2, 0.0)
ops.fix(1, 1)
ops.mass(2, {MASS})
ops.uniaxialMaterial('Elastic', 1, {SPRING})
ops.element('zeroLength', 1, 1, 2, '-mat', 1, '-dir', 1)
ops.rayleigh({2 * RATIO * math.sqrt(SPRING / MASS)}, 0.0, 0.0, 0.0)
ops.element('genericClient', 2, '-node', 2, '-dof', 1, '-server', int(sys.argv[1]), '127.0.0.1'{options})
ops.timeSeries('Path', 1, '-dt', {STEP}, '-values', *{load}, '-useLast')
ops.pattern('Plain', 1, 1)
ops.load(2, 1.0)
ops.constraints('Plain')
ops.numberer('Plain')
ops.system('BandGeneral')
ops.test('NormDispIncr', 1e-10, 10)
ops.algorithm({algorithm})
ops.integrator({integrator})
ops.analysis('Transient')
failed = ops.analyze({steps}, {STEP})
print('failed' if failed else 'done', ops.nodeDisp(2, 1))
{then}
ops.wipe()
"""


def hybrid() -> Plan:
    """The same test with the structure in the engine."""
    storey = {"mass": MASS, "stiffness": SPRING}
    structure = {"kind": "shear_building", "storeys": [storey], "damping_ratio": RATIO}
    forces = [LOAD.model_dump(mode="json")]
    step = {"kind": "explicit_newmark", "dt": STEP, "substeps": 10}
    changed = {"structure": structure, "forces": forces, "integrator": step, "duration": STEPS * STEP}
    return read_plan({"controller_rate": 1000.0, "stations": [STATION], **changed})


@pytest.mark.parametrize("transport", ["tcp", "udp"])
def test_opensees_with_the_rig_equals_the_engine_with_the_rig(transport: str) -> None:
    """Explicit Newmark of both programs is one recursion, so that only rounding differs: 1e-12 of the peak a step at most."""
    options = ", '-udp'" if transport == "udp" else ""
    given = script("'NewmarkExplicit', 0.5", options=options)
    session = served(led([STATION], {"transport": transport}), lambda session: opensees(session, peer.PYTHON, given))
    own = simulate(hybrid())
    run = session.run
    assert run.trip is None and session.told()["steps"] == STEPS and run.done == STEPS * 10
    peak = float(np.max(np.abs(own.signal("x_cmd.1"))))
    columns = [channel.key for channel in run.channels]
    assert peak > 0.005
    for key in ("x_cmd.1", "x_meas.1"):
        difference = run.signals[: run.done, columns.index(key)] - own.signal(key)
        assert np.max(np.abs(difference)) < 1e-12 * STEPS * peak
    messages = session.told()["messages"]
    assert messages == {"3": 2 * STEPS + 1, "5": STEPS, "10": STEPS, "14": 2 * STEPS, "15": 1, "99": 1}


def test_newton_iterations_are_recognised() -> None:
    given = script("'Newmark', 0.5, 0.25", "'Newton'", steps=5)
    stiff = STATION | {"equivalent_stiffness": 2.0e6}
    told = served(led([stiff]), lambda session: opensees(session, peer.PYTHON, given)).told()
    assert told["iterations"] >= 4 and "iterates" in told["warnings"][0] and told["messages"]["14"] > 4 * 5


def test_an_operator_splitting_scheme_sends_one_displacement_a_step() -> None:
    given = script("'AlphaOS', 1.0", steps=5)
    told = served(
        led([STATION | {"equivalent_stiffness": 2.0e6}]), lambda session: opensees(session, peer.PYTHON, given)
    ).told()
    assert told["iterations"] == 0 and told["unfollowed_m"] == 0 and not told["warnings"] and told["steps"] == 5


def test_a_killed_opensees_and_results_after_a_trip_are_safe() -> None:
    """A trip answers NaN, so that OpenSees ends and its results cannot be taken for measurements; a killed client vanished."""
    narrow = STATION | {"limits": {"displacement": 0.001, "velocity": 0.5, "force": 1e6}}
    said: list[str] = []
    given = script("'NewmarkExplicit', 0.5")
    tripped = served(led([narrow]), lambda session: said.append(opensees(session, peer.PYTHON, given).stdout))
    assert tripped.run.trip is not None and tripped.run.trip.limit == "displacement" and "nan" in said[0]

    def killed(session: Session) -> None:
        port = session.address.rpartition(":")[2]
        wait = "import time; print('ready', flush=True); time.sleep(600)"
        started = subprocess.Popen([peer.PYTHON, "-c", script("'NewmarkExplicit', 0.5", steps=20, then=wait), port], stdout=-1)
        with started:
            assert started.stdout is not None and b"done" in started.stdout.readline() and started.stdout.readline()
            started.send_signal(signal.SIGKILL)

    gone = served(led([STATION]), killed)
    assert gone.run.trip is not None and "vanished" in gone.run.trip.sentence and gone.run.done == 200


def test_the_page_on_opensees_holds_a_plan_and_a_script_that_run_as_they_stand(tmp_path: Path) -> None:
    """The plan, the command and the script of docs/opensees-rig.md, with a free port in place of 8090."""
    page = (Path(__file__).parents[2] / "docs" / "opensees-rig.md").read_text()
    blocks = {kind: text for kind, text in re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)}
    (tmp_path / "rig.yaml").write_text(blocks["yaml"])
    assert "element genericClient 2 -node 2 -dof 1 -server 8090 127.0.0.1" in page and '"-server", port' in blocks["python"]
    command = [*blocks["sh"].split(), "--listen", "0", "--json"]
    assert command[0] == "rths"
    with subprocess.Popen(
        [sys.executable, "-m", "app.cli", *command[1:]], cwd=tmp_path, stdout=-1, stderr=-1, text=True
    ) as rig:
        assert rig.stderr is not None
        port = next(found[1] for line in rig.stderr if (found := re.search(r"at 127\.0\.0\.1:(\d+) by TCP", line)))
        done = subprocess.run([peer.PYTHON, "-c", blocks["python"], port], capture_output=True, text=True)
        out, err = rig.communicate()
    assert rig.returncode == 0 and "Client connected" in err
    summary = json.loads(out)
    assert summary["status"] == "completed" and summary["client"]["steps"] == 1000 and not summary["client"]["warnings"]
    reached = float(re.search(r"done: (\S+) mm", done.stdout)[1])  # type: ignore[index]
    recorded = load(tmp_path / "rig.h5").signal("x_cmd.1")
    assert len(recorded) == 10_000 and 1e3 * recorded[-1] == pytest.approx(reached, abs=5.1e-4)  # printed with three decimals
