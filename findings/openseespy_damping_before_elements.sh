#!/usr/bin/env bash
# OpenSees's Rayleigh damping acts only on the elements that exist when it is declared.
#
# Surprise:    `rayleigh(...)` before `element(...)` damps nothing: a 5 % damped oscillator then vibrates without decay, without a
#              warning. The same line after the elements works. Elements added later (a damper, a substructure) stay undamped too.
# Version:     openseespy 3.7.1.2
# Expectation: the command reads like a property of the model, as its integrator or its time step: C = a M + b K of the whole
#              structure. OpenSees's manual says that it assigns damping to all elements and nodes "previously defined".
# For users:   declare Rayleigh damping last, and check the decay of a free vibration before you use OpenSees as a reference or
#              as the numerical substructure: a diagnosis would report the missing inherent damping.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check openseespy==3.7.1.2 numpy==2.4.6
libraries=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/openseespylinux/lib
LD_LIBRARY_PATH="$libraries" "$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
import openseespy.opensees as ops

OMEGA, DAMPING = 2 * np.pi, 0.05


def peaks(damping_first):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1.0)
    ops.uniaxialMaterial("Elastic", 1, OMEGA**2)
    if damping_first:
        ops.rayleigh(0.0, 2 * DAMPING / OMEGA, 0.0, 0.0)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1, "-doRayleigh", 1)
    if not damping_first:
        ops.rayleigh(0.0, 2 * DAMPING / OMEGA, 0.0, 0.0)
    ops.setNodeVel(2, 1, 1.0, "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm("Linear")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    path = np.abs([(ops.analyze(1, 0.005), ops.nodeDisp(2, 1))[1] for _ in range(2000)])
    return path[:200].max(), path[-200:].max()


print("openseespy", version("openseespy"))
law = np.exp(-DAMPING * OMEGA * 9)
before, after = peaks(True), peaks(False)
print(f"peak of the 10th period over that of the 1st, 5 % damping: expected about {law:.3f} wherever the damping is declared")
print(f"seen: {before[1] / before[0]:.3f} declared before the element, {after[1] / after[0]:.3f} declared after it")
if not (before[1] / before[0] > 0.999 and abs(after[1] / after[0] / law - 1) < 0.1):
    sys.exit("The behaviour has changed.")
PY
