"""`python -m benchmarks.rig`: OpenSees and `rths rig` on one machine, time of each step of OpenSees by TCP and UDP.

The structure has one degree of freedom, so that the exchange is measured. OpenSees times its own steps. `alone` is the same
analysis with a spring in place of the rig.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_to_yaml
from rths_engine.planning.templates import template
from rths_engine.running.warm import warm
from tests.opensees import peer

STEPS, STEP = 4096, 10 / 1024
REAL_TIME_MS = 1e3 * STEP
SCHEMES = {
    "NewmarkExplicit, Linear": ("'NewmarkExplicit', 0.5", "'Linear'"),
    "Newmark, Linear": ("'Newmark', 0.5, 0.25", "'Linear'"),
    "AlphaOS, Linear": ("'AlphaOS', 0.9", "'Linear'"),
    "Newmark, Newton": ("'Newmark', 0.5, 0.25", "'Newton'"),
}
SCRIPT = """
import json, sys, time
import openseespy.opensees as ops
port, udp = int(sys.argv[1]), sys.argv[2] == 'udp'
ops.model('basic', '-ndm', 1, '-ndf', 1)
ops.node(1, 0.0); ops.node(2, 0.0); ops.fix(1, 1); ops.mass(2, 2.0e5)
ops.uniaxialMaterial('Elastic', 1, 8.0e6); ops.uniaxialMaterial('Elastic', 2, 2.0e6)
ops.element('zeroLength', 1, 1, 2, '-mat', 1, '-dir', 1)
if port:
    ops.element('genericClient', 2, '-node', 2, '-dof', 1, '-server', port, '127.0.0.1', *(['-udp'] if udp else []))
else:
    ops.element('zeroLength', 2, 1, 2, '-mat', 2, '-dir', 1)
ops.timeSeries('Trig', 1, 0.0, 1e9, 1.25, '-factor', 5.0e4); ops.pattern('Plain', 1, 1); ops.load(2, 1.0)
ops.constraints('Plain'); ops.numberer('Plain'); ops.system('BandGeneral'); ops.test('NormDispIncr', 1e-10, 10)
ops.algorithm({algorithm}); ops.integrator({integrator}); ops.analysis('Transient')
taken, clock, analyze = [], time.perf_counter, ops.analyze
for _ in range({steps}):
    begun = clock()
    analyze(1, {step})
    taken.append(clock() - begun)
ops.wipe()
print(json.dumps(taken))
"""


def main() -> None:
    """Measure every scheme by TCP, by UDP and without the rig, and print and return the figures."""
    if reason := peer.missing():
        sys.exit(reason)
    warm()
    print(f"load average at the start: {os.getloadavg()[0]:.2f} on {os.cpu_count()} cores; {STEPS} steps each")
    print(f"{'':26}{'':6}{'median':>10}{'95 %':>10}{'longest':>10}  ms  {'over 9.77 ms':>14}")
    for name, (integrator, algorithm) in SCHEMES.items():
        script = SCRIPT.format(integrator=integrator, algorithm=algorithm, steps=STEPS, step=STEP)
        for transport in ("tcp", "udp", "alone"):
            taken = np.array(_opensees(script, 0, "") if transport == "alone" else _with_rig(script, transport)) * 1e3
            median, p95, longest = np.percentile(taken, (50, 95, 100))
            over = int(np.sum(taken > REAL_TIME_MS))
            print(f"{name:26}{transport:6}{median:10.4f}{p95:10.4f}{longest:10.3f}      {over:14d}", flush=True)
    print(f"load average at the end: {os.getloadavg()[0]:.2f}")


def _with_rig(script: str, transport: str) -> list[float]:
    """The times of the steps (s) with the rig."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rig.yaml"
        path.write_text(plan_to_yaml(_plan()))
        command = [sys.executable, "-m", "app.cli", "rig", str(path), "--listen", "0", "--json"]
        with subprocess.Popen(
            [*command, *(["--udp"] if transport == "udp" else [])], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as rig:
            assert rig.stderr is not None
            port = next(int(found[1]) for line in rig.stderr if (found := re.search(r"at 127\.0\.0\.1:(\d+) by", line)))
            taken = _opensees(script, port, transport)
            out, err = rig.communicate()
            if rig.returncode or json.loads(out)["client"]["steps"] != STEPS:
                sys.exit(f"The rig did not serve all steps: {err}")
    return taken


def _plan() -> Plan:
    plan = template("opensees-client")
    return plan.model_copy(update={"controller_rate": 1024.0, "pace": Plan().pace})


def _opensees(script: str, port: int, transport: str) -> list[float]:
    done = subprocess.run([peer.PYTHON, "-c", script, str(port), transport], capture_output=True, text=True, check=True)
    taken: Any = json.loads(done.stdout.splitlines()[-1])
    return [float(one) for one in taken]


if __name__ == "__main__":
    main()
