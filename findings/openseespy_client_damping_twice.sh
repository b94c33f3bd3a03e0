#!/usr/bin/env bash
# The element genericClient of OpenSees adds damping answer times velocity to the measured force: a specimen's damping counts twice.
#
# Surprise:    a server that answers the damping of its specimen to action 14 (getDamp), as it answers its stiffness to 13, doubles the
#              damping: the element returns the measured force, which contains c v, plus C v with the answer C. The stiffness that is
#              answered is used for the tangent only.
# Version:     openseespy 3.7.1.2
# Expectation: tangent matrices of an experimental element help the integrator, and the force is the measured one.
# For users:   answer zeros to action 14 (and to 15, the mass), whatever the specimen; check the decay of a free vibration.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check openseespy==3.7.1.2 numpy==2.4.6
libraries=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/openseespylinux/lib
cat > "$work/structure.py" <<'PY'
import sys

import openseespy.opensees as ops

ops.model("basic", "-ndm", 1, "-ndf", 1)
ops.node(1, 0.0)
ops.node(2, 0.0)
ops.fix(1, 1)
ops.mass(2, 1.0)
ops.uniaxialMaterial("Elastic", 1, 39.4784176)  # a period of 1 s
ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
ops.element("genericClient", 2, "-node", 2, "-dof", 1, "-server", int(sys.argv[1]), "127.0.0.1")
ops.timeSeries("Path", 1, "-time", 0.0, 0.25, 0.5, 0.51, "-values", 0.0, 1.0, 0.0, 0.0)
ops.pattern("Plain", 1, 1)
ops.load(2, 1.0)
ops.constraints("Plain")
ops.numberer("Plain")
ops.system("FullGeneral")
ops.algorithm("Linear")
ops.integrator("NewmarkExplicit", 0.5)
ops.analysis("Transient")
print(*((ops.analyze(1, 0.005), ops.nodeDisp(2, 1))[1] for _ in range(1600)))
ops.wipe()
PY
LD_LIBRARY_PATH="$libraries" "$work/venv/bin/python" -W ignore - "$work/structure.py" <<'PY'
import math
import socket
import struct
import subprocess
import sys
from importlib.metadata import version

import numpy as np

DAMPING = 2 * 0.03 * 2 * math.pi  # 3 % of the oscillator with m = 1 and 1 s


def decay(answered):
    """Damping ratio of the free vibration with a dashpot at the server, which answers `answered` to action 14."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        port = str(listening.getsockname()[1])
        structure = subprocess.Popen([sys.executable, sys.argv[1], port], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        peer = listening.accept()[0].makefile("rwb")
    size, velocity = struct.unpack("<11i", peer.read(44))[10], 0.0
    while (numbers := struct.unpack(f"<{size}d", peer.read(8 * size)))[0] != 99:
        action = int(numbers[0])
        if action == 3:
            velocity = numbers[2]
        if 6 <= action <= 15:
            value = {10: DAMPING * velocity, 14: answered}.get(action, 0.0)
            peer.write(struct.pack(f"<{size}d", value, *[0.0] * (size - 1)))
            peer.flush()
    path = np.array(structure.communicate()[0].split()[:1600], dtype=float)[120:]
    peaks = [path[k] for k in range(1, len(path) - 1) if path[k - 1] < path[k] >= path[k + 1]]
    return math.log(peaks[0] / peaks[5]) / (2 * math.pi * 5)


print("openseespy", version("openseespy"))
zero, twice = decay(0.0), decay(DAMPING)
print(f"a dashpot of 3 % at the server: damping of the free vibration {zero:.4f} where 14 is answered with zero")
print(f"expected 0.0300 where 14 is answered with the dashpot; seen {twice:.4f}")
if not (abs(zero - 0.03) < 0.001 and abs(twice - 0.06) < 0.002):
    sys.exit("The behaviour has changed.")
PY
