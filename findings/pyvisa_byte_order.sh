#!/usr/bin/env bash
# PyVISA reads the binary block of an instrument in the opposite byte order of SCPI's default.
#
# Surprise:    a block of 32-bit floats from an instrument at its SCPI default settings decodes to numbers around 1e-41, without an
#              error: 1.0 V becomes 4.6e-41. PyVISA's `query_binary_values`, `read_binary_values` and `from_ieee_block` assume
#              little-endian by default; SCPI's default order is big-endian.
# Version:     PyVISA 1.16.2
# Expectation: the SCPI-99 standard: FORMat:BORDer is NORMal after a reset, which is the most significant byte first.
# For users:   send `FORM:BORD SWAP` to the instrument, or read with `is_big_endian=True`. Values that are all zero or below 1e-30
#              in an imported file of an oscilloscope or a data logger are a sign of it.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check PyVISA==1.16.2
"$work/venv/bin/python" -W ignore - <<'PY'
import struct
import sys

import pyvisa
from pyvisa.util import from_ieee_block

print("PyVISA", pyvisa.__version__)
volts = [0.0, 1.0, -2.5, 1000.0]
data = struct.pack(f">{len(volts)}f", *volts)
block = b"#2" + f"{len(data):02d}".encode() + data + b"\n"
seen, right = from_ieee_block(block, datatype="f"), from_ieee_block(block, datatype="f", is_big_endian=True)
print(f"block in SCPI's default byte order: expected {volts}; seen {seen} by default, {right} with is_big_endian=True")
if not (right == volts and max(map(abs, seen)) < 1e-38):
    sys.exit("The behaviour has changed.")
PY
