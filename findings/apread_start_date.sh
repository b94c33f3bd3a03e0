#!/usr/bin/env bash
# apread gives measurements of HBM catman a date in 1970, and drops a channel of a length that no other channel has.
#
# Surprise:    a file of 12 April 2022, 13:32:09 gets the date 1970-01-01 12:24:23. A channel group is found by its length: the only channel
#              with 50 samples beside three with 100 samples is missing from the result. No error or warning occurs.
# Version:     apread 1.1.3
# Expectation: catman stores dates as OLE dates (days since 30 December 1899: 44663.56); the names of the package's own samples
#              (2022_04_12_13_32_10) agree. It has a function for this (`toTimestamp`), but does not call it. All channels are read.
# For users:   add `datetime(1899, 12, 30) + timedelta(days=channel.time)`; compare the number of channels with `numChannels`.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check apread==1.1.3 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY' 2>errors.txt || { tail -5 errors.txt; exit 1; }
import datetime
import struct
import sys
from importlib.metadata import version

import numpy as np
from apread import APReader

print("apread", version("apread"))
start = datetime.datetime(2022, 4, 12, 13, 32, 9)
ole_date = (start - datetime.datetime(1899, 12, 30)) / datetime.timedelta(days=1)

def text(value, size="<h"):
    data = value.encode("cp1252")
    return struct.pack(size, len(data)) + data

def channel(number, name, unit, values):
    extended = struct.pack("<dd", ole_date, 10.0) + bytes(148 - 16)  # start, step in ms; export format 0: doubles
    head = struct.pack("<hi", number, len(values)) + text(name) + text(unit) + text("")
    head += struct.pack("<hhdi", 0, 8, ole_date, len(extended)) + extended
    return head + b"0" + b"0" + struct.pack("<bh", 0, 0) + text("") + text("", "<i")

values = {
    ("Time  1 - default sample rate", "s"): np.arange(100) / 100,
    ("Force", "kN"): np.sin(np.arange(100) / 5),
    ("Displacement", "mm"): np.cos(np.arange(100) / 5),
    ("Temperature", "Cel"): np.full(50, 21.5),
}
channels = b"".join(channel(n, *key, data) for n, (key, data) in enumerate(values.items(), start=1))
front = text("") + text(" ") * 32 + struct.pack("<hi", len(values), 0) + struct.pack("<i", 0) * len(values) + struct.pack("<i", 0)
offset = 6 + len(front) + len(channels)
with open("test.bin", "wb") as file:
    file.write(struct.pack("<hi", 5012, offset) + front + channels + b"".join(v.astype("<f8").tobytes() for v in values.values()))

read = APReader("test.bin")
names, force = [c.Name for c in read.Channels], next(c for c in read.Channels if c.Name == "Force")
print(f"expected {len(values)} channels and the date {start}")
print(f"seen {len(names)} channels of {read.numChannels}, date {force.date}; missing: {sorted({k[0] for k in values} - set(names))}")
if not (np.array_equal(force.data, values["Force", "kN"]) and force.date.year == 1970 and "Temperature" not in names):
    sys.exit("The behaviour has changed.")
PY
