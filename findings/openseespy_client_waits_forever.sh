#!/usr/bin/env bash
# The element genericClient of OpenSees does not notice that its server has closed the connection: it waits forever, with a whole core.
#
# Surprise:    when the server of the rig ends while OpenSees waits for a force, `analyze` neither fails nor returns. By TCP it asks the
#              closed connection again and again, with all of one processor core, and prints nothing.
# Version:     openseespy 3.7.1.2
# Expectation: a read of a closed connection returns 0 bytes, and the analysis ends with an error.
# For users:   give scripts with a genericClient a time limit of their own. A server that stops a test should go on answering, for
#              example with NaN, until the client leaves.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check openseespy==3.7.1.2
libraries=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/openseespylinux/lib
cat > "$work/structure.py" <<'PY'
import sys

import openseespy.opensees as ops

ops.model("basic", "-ndm", 1, "-ndf", 1)
ops.node(1, 0.0)
ops.node(2, 0.0)
ops.fix(1, 1)
ops.mass(2, 1.0)
ops.uniaxialMaterial("Elastic", 1, 1.0)
ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
ops.element("genericClient", 2, "-node", 2, "-dof", 1, "-server", int(sys.argv[1]), "127.0.0.1")
ops.constraints("Plain")
ops.numberer("Plain")
ops.system("FullGeneral")
ops.algorithm("Linear")
ops.integrator("NewmarkExplicit", 0.5)
ops.analysis("Transient")
ops.analyze(10, 0.01)
PY
LD_LIBRARY_PATH="$libraries" "$work/venv/bin/python" -W ignore - "$work/structure.py" <<'PY'
import os
import socket
import struct
import subprocess
import sys
import time
from importlib.metadata import version

print("openseespy", version("openseespy"))
with socket.create_server(("127.0.0.1", 0)) as listening:
    port = str(listening.getsockname()[1])
    structure = subprocess.Popen([sys.executable, sys.argv[1], port], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    connection = listening.accept()[0]
peer = connection.makefile("rwb")
size, answers = struct.unpack("<11i", peer.read(44))[10], 0
while not 6 <= struct.unpack(f"<{size}d", peer.read(8 * size))[0] <= 15:
    pass  # until OpenSees asks for an answer
connection.shutdown(socket.SHUT_RDWR)


def used():
    fields = open(f"/proc/{structure.pid}/stat").read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


time.sleep(1.0)
begun, before = time.monotonic(), used()
time.sleep(4.0)
ended, share = structure.poll(), (used() - before) / (time.monotonic() - begun)
structure.kill()
print(f"5 s after the server closed the connection: expected an end with an error; seen {'an end' if ended is not None else 'none'}, "
      f"and {'most' if share > 0.15 else 'little'} of the processor used")
if ended is not None or share < 0.15:  # all of a core, less what other work on the machine takes
    sys.exit("The behaviour has changed.")
PY
