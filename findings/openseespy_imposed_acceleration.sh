#!/usr/bin/env bash
# OpenSees cuts a support motion given by acceleration to whole seconds, then moves the support back to zero.
#
# Surprise:    `groundMotion(1, "Plain", "-accel", series)` in a MultipleSupport pattern integrates the acceleration to displacement. Of a record
#              of 2.5 s the node follows the first 1.99 s; at 2 s it jumps to zero displacement and stays there. Of a record of 0.8 s nothing
#              is left. `analyze` returns 0 and nothing is printed.
# Version:     openseespy 3.7.1.2
# Expectation: the motion lasts as long as its record, as it does when the same motion is given with `-disp`.
# For users:   give `-disp`, or add zeros to the record up to the next whole second and beyond the end of the analysis. Compare the
#              displacement of the node with the motion that you gave.
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


def followed(seconds):
    t = 0.01 * np.arange(round(seconds / 0.01) + 1)
    oscillator()
    ops.node(3, 0.0)
    ops.element("zeroLength", 2, 1, 3, "-mat", 1, "-dir", 1)
    ops.mass(3, 1.0)
    ops.timeSeries("Path", 1, "-dt", 0.01, "-values", *(0.01 * 2.3**2 * np.cos(2.3 * t)), "-useLast")
    ops.pattern("MultipleSupport", 1)
    ops.groundMotion(1, "Plain", "-accel", 1)
    ops.imposedMotion(2, 1, 1)
    ops.test("NormDispIncr", 1e-10, 10)
    analysis("Newmark", 0.5, 0.25, constraints="Transformation", algorithm="Newton")
    moved = np.array([(ops.analyze(1, 0.01), ops.nodeDisp(2, 1))[1] for _ in t[1:]])
    wanted = 0.01 * (1 - np.cos(2.3 * t[1:]))
    last = np.flatnonzero(moved)[-1] + 1 if moved.any() else 0
    return 0.01 * last, np.abs(moved - wanted)[:last].max(initial=0.0), wanted[-1], moved[-1]


long, short = followed(2.5), followed(0.8)
for seconds, (last, wrong, wanted, moved) in ((2.5, long), (0.8, short)):
    print(f"{seconds} s: expected to follow {seconds} s and to end at {wanted:.5f} m; seen {last:.2f} s (error {wrong:.1e} m), then {moved} m")
if not (abs(long[0] - 1.99) < 1e-9 and long[1] < 1e-4 and long[3] == 0 and short[0] == 0):
    sys.exit("The behaviour has changed.")
PY
