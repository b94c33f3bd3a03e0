#!/usr/bin/env bash
# Two readers of PEER's AT2 format lose the last line of a record; one of the two writes it into the middle.
#
# Surprise:    a record ends with a shorter line if its number of points is not a multiple of five. earthquakepy computes the
#              position of a line from the length of that line, so the last points overwrite two earlier points (of 2002 points:
#              numbers 800 and 801) and the end of the record is zero. quakeio always drops the last line, also a full line, so up
#              to five points are missing. Neither raises an error; both read NPTS from the header.
# Version:     earthquakepy 0.4.1, quakeio 0.1.21
# Expectation: PEER's ground-motion files state NPTS and DT in the fourth line; NPTS values follow, five a line, in order.
# For users:   compare the number of points with NPTS, and the samples with the file's, before you run a test with a record that
#              another program has read and saved. A jump in the middle of the record loads the specimen with an impact.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check earthquakepy==0.4.1 quakeio==0.1.21
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import earthquakepy
import numpy as np
import quakeio


def write(name, count):
    motion = 0.1 * np.sin(np.arange(1, count + 1) / 30)
    with open(name, "w") as file:
        file.write("PEER NGA STRONG MOTION DATABASE RECORD\nMade up, 1/1/2000, Nowhere, 0\n")
        file.write(f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   {count}, DT=   .0050 SEC,\n")
        for start in range(0, count, 5):
            file.write("".join(f"{value:15.7E}" for value in motion[start : start + 5]) + "\n")
    return motion


print("earthquakepy", version("earthquakepy"), "and quakeio", version("quakeio"))
motion = write("short.AT2", 2002)
read = earthquakepy.read_peer_nga_file("short.AT2").y
wrong = np.flatnonzero(np.abs(read - motion) > 1e-6).tolist()
print(f"earthquakepy, NPTS 2002: expected no wrong sample; seen wrong samples {wrong}, now {np.round(read[wrong], 4).tolist()}")
lengths = {}
for count in (2002, 2000):
    write("short.AT2", count)
    lengths[count] = len(quakeio.read("short.AT2").data)
    print(f"quakeio, NPTS {count}: expected {count} samples; seen {lengths[count]}")
moved = np.allclose(read[[800, 801]], motion[-2:], atol=1e-6) and np.all(read[-2:] == 0)
if not (wrong == [800, 801, 2000, 2001] and moved and lengths == {2002: 2000, 2000: 1995}):
    sys.exit("The behaviour has changed.")
PY
