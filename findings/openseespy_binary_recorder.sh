#!/usr/bin/env bash
# OpenSees writes a line feed after every row of a binary recorder file, so the file is not an array of doubles.
#
# Surprise:    a recorder with `-binary` writes 25 bytes for a row of three doubles: 24 bytes and a line feed. Read as doubles, every number
#              after the first row is wrong, and no error occurs when the length happens to be a multiple of eight.
# Version:     openseespy 3.7.1.2 (OpenSees 3.7.1)
# Expectation: the manual of the recorder says that `-binary` writes the results in binary form; `numpy.fromfile` reads doubles.
# For users:   read rows as (columns of doubles, one byte), for example `numpy.dtype([("row", "<f8", 3), ("line feed", "S1")])`, and check that
#              the last byte of every row is a line feed. Or record text with `-precision 16`.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check openseespy==3.7.1.2 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
import openseespy.opensees as ops

print("openseespy", version("openseespy"))
steps = 400
ops.model("basic", "-ndm", 1, "-ndf", 1)
for node in (1, 2, 3):
    ops.node(node, 0.0)
ops.fix(1, 1)
ops.mass(2, 1.0)
ops.mass(3, 0.5)
ops.uniaxialMaterial("Elastic", 1, 100.0)
ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
ops.element("zeroLength", 2, 2, 3, "-mat", 1, "-dir", 1)
ops.timeSeries("Constant", 1)
ops.pattern("Plain", 1, 1)
ops.load(3, 1.0)
ops.recorder("Node", "-binary", "response.bin", "-time", "-node", 2, 3, "-dof", 1, "disp")
for command in (("constraints", "Plain"), ("numberer", "Plain"), ("system", "BandGeneral"), ("algorithm", "Linear"),
                ("integrator", "Newmark", 0.5, 0.25), ("analysis", "Transient")):
    getattr(ops, command[0])(*command[1:])
expected = np.empty((steps, 3))
for step in range(steps):
    ops.analyze(1, 0.01)
    expected[step] = ops.getTime(), ops.nodeDisp(2, 1), ops.nodeDisp(3, 1)
ops.wipe()

data = open("response.bin", "rb").read()
plain = np.fromfile("response.bin")
print(f"expected {steps} rows of 3 doubles: {steps * 24} bytes; seen {len(data)} bytes, {plain.size} doubles")
print(f"second row, expected {expected[1].tolist()}, seen {plain[3:6].tolist()}")
rows = np.frombuffer(data, dtype=[("row", "<f8", 3), ("end", "S1")]) if len(data) % 25 == 0 else None
good = rows is not None and set(rows["end"]) == {b"\n"} and np.array_equal(rows["row"], expected)
print(f"rows of 25 bytes with a line feed at the end give the exact values: {good}")
if not (len(data) == steps * 25 and good and not np.isclose(plain[4], expected[1, 1])):
    sys.exit("The behaviour has changed.")
PY
