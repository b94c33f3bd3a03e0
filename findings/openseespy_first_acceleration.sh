#!/usr/bin/env bash
# OpenSees starts a free vibration with zero acceleration, so Newmark's method becomes a first-order method.
#
# Surprise:    a transient analysis from an initial displacement (`setNodeDisp ... -commit`) does not solve the equation of motion
#              for the acceleration at time zero; it takes zero. The average-acceleration method then makes an error of first
#              order: at 100 steps a period it is 4 times the method's own error, and halving the step halves it instead of
#              quartering it. The result equals a hand-written Newmark recursion with a zero first acceleration to rounding.
# Version:     openseespy 3.7.1.2
# Expectation: Newmark's method starts from a(0) = (p(0) - c v(0) - k x(0)) / m, as in his paper of 1959 and every textbook.
# For users:   when you compare a run with OpenSees, start from rest with a motion that begins at zero, or give OpenSees the
#              initial acceleration too (`setNodeAccel`). Otherwise a correct integrator seems to have an error in the first step.
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

OMEGA = 2 * np.pi


def opensees(step, acceleration=None):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1.0)
    ops.uniaxialMaterial("Elastic", 1, OMEGA**2)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.setNodeDisp(2, 1, 1.0, "-commit")
    if acceleration is not None:
        ops.setNodeAccel(2, 1, acceleration, "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm("Linear")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    return np.array([(ops.analyze(1, step), ops.nodeDisp(2, 1))[1] for _ in range(round(5 / step))])


def newmark(step, acceleration):
    x, v, a, path = 1.0, 0.0, acceleration, []
    for _ in range(round(5 / step)):
        x, v = x + step * v + step**2 / 4 * a, v + step / 2 * a
        a = -(OMEGA**2) * x / (1 + (OMEGA * step) ** 2 / 4)
        x, v = x + step**2 / 4 * a, v + step / 2 * a
        path.append(x)
    return np.array(path)


print("openseespy", version("openseespy"))
seen, right, given, same = [], [], [], True
for step in (0.01, 0.005, 0.0025):
    exact = np.cos(OMEGA * step * np.arange(1, round(5 / step) + 1))
    path = opensees(step)
    same &= bool(np.allclose(path, newmark(step, 0.0), atol=1e-9))
    seen.append(np.abs(path - exact).max())
    right.append(np.abs(newmark(step, -(OMEGA**2)) - exact).max())
    given.append(np.abs(opensees(step, -(OMEGA**2)) - exact).max())
    print(f"step {step:g} s, unit initial displacement, 5 periods: expected error {right[-1]:.5f}; seen {seen[-1]:.5f}; "
          f"with setNodeAccel {given[-1]:.5f}")
print(f"a(0) = 0 reproduces it: {same}; order from the last halving: expected {np.log2(right[1] / right[2]):.2f}; "
      f"seen {np.log2(seen[1] / seen[2]):.2f}")
if not (same and np.allclose(given, right, rtol=1e-6) and np.log2(seen[1] / seen[2]) < 1.3 < 1.9 < np.log2(right[1] / right[2])):
    sys.exit("The behaviour has changed.")
PY
