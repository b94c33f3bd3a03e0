#!/usr/bin/env bash
# OpenSees's load path: `-useLast` has no effect with `-time`, and with `-dt` the path is zero at its own last point.
#
# Surprise:    `timeSeries("Path", 1, "-time", 0, 0.5, 1, "-values", 1, 1, 1, "-useLast")` is 0 at 1.5 s, as without `-useLast`. With `-dt` the
#              flag works, and without it the factor is 0 already at 1 s, the time of the last value, where `-time` gives 1.
# Version:     openseespy 3.7.1.2
# Expectation: `-useLast` uses the last value after the end of the series, in both forms. A series has its last value at the time of its last
#              value, however its times are given.
# For users:   add one more point after the end of the analysis, in both forms. A motion that ends with a value other than zero is otherwise
#              unloaded in one step.
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


def factors(*path):
    oscillator()
    ops.timeSeries("Path", 1, *path)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 1.0)
    analysis("LoadControl", 0.5, kind="Static")
    return [(ops.analyze(1), ops.getLoadFactor(1))[1] for _ in range(3)]


seen = {}
for name, form in (("-dt", ("-dt", 0.5)), ("-time", ("-time", 0.0, 0.5, 1.0))):
    for last in ((), ("-useLast",)):
        seen[name, bool(last)] = factors(*form, "-values", 1.0, 1.0, 1.0, *last)
        expected = [1.0, 1.0, 1.0 if last else 0.0]
        print(f"{name} {' '.join(last)}: factors at 0.5, 1 and 1.5 s: expected {expected}; seen {seen[name, bool(last)]}")
if not (seen["-dt", False] == [1, 0, 0] and seen["-dt", True] == [1, 1, 1] and seen["-time", False] == seen["-time", True] == [1, 1, 0]):
    sys.exit("The behaviour has changed.")
PY
