#!/usr/bin/env bash
# OpenSees's recorder with `-dT` does not write every dT: the rows are whole steps apart, counted from the row before.
#
# Surprise:    with steps of 1/1024 s, `-dT 0.01` writes rows 10.742 ms apart (11 steps), so 2000 steps give 182 rows, where rows every 10 ms
#              are 195. The shortfall adds up: row 182 is 0.13 s later than 182 times 10 ms. The first row is the end of the first step.
# Version:     openseespy 3.7.1.2
# Expectation: OpenSees's manual calls `-dT` the time interval for recording, and adds that a step is recorded when it is dT greater than the last
#              recorded one. A reader of a file without a time column takes rows every dT.
# For users:   record `-time` and take the step from it, or choose a dT that is a multiple of the step.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check openseespy==3.7.1.2 numpy==2.4.6
libraries=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/openseespylinux/lib
cd "$work"
LD_LIBRARY_PATH="$libraries" "$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
import openseespy.opensees as ops

OMEGA = 2 * np.pi


def oscillator():
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1.0)
    ops.uniaxialMaterial("Elastic", 1, OMEGA**2)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)


def analysis(*integrator, kind="Transient", constraints="Plain", algorithm="Linear"):
    ops.constraints(constraints)
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm(algorithm)
    ops.integrator(*integrator)
    ops.analysis(kind)


print("openseespy", version("openseespy"))

oscillator()
ops.timeSeries("Constant", 1)
ops.pattern("Plain", 1, 1)
ops.load(2, 1.0)
ops.recorder("Node", "-file", "rows.out", "-precision", 12, "-time", "-dT", 0.01, "-node", 2, "-dof", 1, "disp")
analysis("Newmark", 0.5, 0.25)
for _ in range(2000):
    ops.analyze(1, 1 / 1024)
ops.remove("recorders")
times = np.loadtxt("rows.out")[:, 0]
apart = 1e3 * np.diff(times).mean()
print(f"2000 steps of 1/1024 s, -dT 0.01: expected 195 rows 10 ms apart; seen {len(times)} rows {apart:.4f} ms apart")
print(f"first row: expected 0 or 0.01 s; seen {times[0]:.6f} s")
if not (len(times) == 182 and np.allclose(np.diff(times), 11 / 1024, atol=1e-9) and abs(times[0] - 1 / 1024) < 1e-9):
    sys.exit("The behaviour has changed.")
PY
