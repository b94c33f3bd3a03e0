#!/usr/bin/env bash
# OpenSees's twoNodeLink with `-doRayleigh 0` has Rayleigh damping: its flag takes no number.
#
# Surprise:    `element("twoNodeLink", ..., "-doRayleigh", 0)` is damped like `"-doRayleigh"`. The same two words on a zeroLength, truss or
#              zeroLengthSection element switch the damping off. Without the flag a twoNodeLink is not damped. Nothing is printed.
# Version:     openseespy 3.7.1.2
# Expectation: the flag means the same on every element: 0 is off, 1 is on. OpenSees's manual shows it without a number for twoNodeLink and with
#              a number for zeroLength, and does not say that a number is ignored.
# For users:   leave `-doRayleigh` out where a link must not be damped, for example a damper or a bearing; check the decay of a free vibration.
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


def decay(name, *more):
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 1.0 if name == "twoNodeLink" else 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 1, 1)
    ops.mass(2, 1.0, 1.0, 1.0)
    ops.uniaxialMaterial("Elastic", 1, OMEGA**2)
    ops.element(name, 1, 1, 2, "-mat", 1, "-dir", 1, *more)
    ops.rayleigh(0.0, 2 * 0.05 / OMEGA, 0.0, 0.0)
    ops.setNodeVel(2, 1, 1.0, "-commit")
    analysis("Newmark", 0.5, 0.25)
    path = np.abs([(ops.analyze(1, 0.01), ops.nodeDisp(2, 1))[1] for _ in range(1000)])
    return float(path[-100:].max() / path[:100].max())


law, seen = float(np.exp(-0.05 * OMEGA * 9)), {}
print(f"peak of the 10th period over that of the 1st: 1 without damping, about {law:.3f} with 5 %")
for name in ("zeroLength", "twoNodeLink"):
    seen[name] = [decay(name), decay(name, "-doRayleigh", 0), decay(name, "-doRayleigh", 1)]
    shown = ", ".join(f"{one:.3f}" for one in seen[name])
    print(f"{name}, no flag, -doRayleigh 0, -doRayleigh 1: expected 1.000, 1.000, {law:.3f}; seen {shown}")
if not (min(seen["zeroLength"][:2]) > 0.999 and seen["twoNodeLink"][0] > 0.999 and abs(seen["twoNodeLink"][1] / law - 1) < 0.1):
    sys.exit("The behaviour has changed.")
PY
