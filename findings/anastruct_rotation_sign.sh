#!/usr/bin/env bash
# anaStruct returns rotations with the opposite sign of the moments that cause them.
#
# Surprise:    a moment load of +10 at the tip of a cantilever lifts it (uy = +0.002), as a counter-clockwise moment does, but the
#              rotation returned is phi_z = -0.002. Moment times rotation, the work of the load, comes out negative; and
#              phi_z is minus the slope of uy.
# Version:     anastruct 1.7.0
# Expectation: Clapeyron: the work of a load on an elastic structure is positive, so a load and its own displacement have the same
#              sign; in a right-handed system a small rotation about z is the slope of uy along x.
# For users:   reverse the sign of rotations before you build a stiffness or flexibility matrix from anaStruct's results: otherwise
#              the rotational terms are negative and the structure seems to generate energy.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check anastruct==1.7.0
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

from anastruct import SystemElements

print("anastruct", version("anastruct"))
length, stiffness, moment, force = 2.0, 1e4, 10.0, 10.0


def tip(**load):
    frame = SystemElements(EA=1e9, EI=stiffness)
    frame.add_element([[0, 0], [length, 0]])
    frame.add_support_fixed(1)
    if "moment" in load:
        frame.moment_load(2, load["moment"])
    else:
        frame.point_load(2, Fy=load["force"])
    frame.solve()
    moved = frame.get_node_displacements(2)
    return float(moved["uy"]), float(moved["phi_z"])


bent, pushed = tip(moment=moment), tip(force=force)
right_bent = moment * length**2 / 2 / stiffness, moment * length / stiffness
right_pushed = force * length**3 / 3 / stiffness, force * length**2 / 2 / stiffness
same = True
for name, seen, right in (("moment +10", bent, right_bent), ("force +10", pushed, right_pushed)):
    print(f"{name} at the tip: expected (uy, phi_z) = ({right[0]:.4g}, {right[1]:.4g}); seen ({seen[0]:.4g}, {seen[1]:.4g})")
    same &= abs(seen[0] / right[0] - 1) < 1e-3 and abs(seen[1] / right[1] + 1) < 1e-3
if not same:
    sys.exit("The behaviour has changed.")
PY
