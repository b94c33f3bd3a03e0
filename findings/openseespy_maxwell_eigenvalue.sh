#!/usr/bin/env bash
# OpenSees's Maxwell material counts with its whole spring in eigenvalues, whatever its dashpot.
#
# Surprise:    a Maxwell damper (spring and dashpot in series) with a spring of 3 k beside a structure of k gives the eigenvalue 4 k / m, also with
#              a dashpot of 1e-6 N s/m, which transmits nothing. The period is half of the true one. `ViscousDamper`, the same model by the same
#              laboratory, adds nothing.
# Version:     openseespy 3.7.1.2
# Expectation: a damper without a spring in parallel has no static stiffness, so it does not change the undamped period. Free vibration agrees:
#              the mass swings at the period of the structure alone.
# For users:   compute periods and Rayleigh coefficients before you add Maxwell dampers, or model them with `ViscousDamper`.
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


def model(damper, coefficient):
    oscillator()
    ops.uniaxialMaterial(damper, 2, 3 * OMEGA**2, coefficient, 1.0, *([1.0] if damper == "Maxwell" else []))
    ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)


seen = {}
for damper in ("Maxwell", "ViscousDamper"):
    model(damper, 1e-6)
    seen[damper] = float(OMEGA / np.sqrt(ops.eigen("-fullGenLapack", 1)[0]))
model("Maxwell", 1e-6)
ops.setNodeVel(2, 1, 1.0, "-commit")
ops.test("NormDispIncr", 1e-10, 20)
analysis("Newmark", 0.5, 0.25, algorithm="Newton")
path = np.array([(ops.analyze(1, 0.005), ops.nodeDisp(2, 1))[1] for _ in range(1000)])
crossings = 0.005 * np.flatnonzero(np.diff(np.sign(path)))
period = 2 * float(np.diff(crossings).mean())
print(f"period of the structure 1 s, dashpot of 1e-6 N s/m; in free vibration {period:.3f} s")
for damper, found in seen.items():
    print(f"{damper}: period by eigen expected 1 s; seen {found:.3f} s")
if not (abs(seen["Maxwell"] - 0.5) < 1e-6 and abs(seen["ViscousDamper"] - 1) < 1e-6 and abs(period - 1) < 0.02):
    sys.exit("The behaviour has changed.")
PY
