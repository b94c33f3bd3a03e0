#!/usr/bin/env bash
# lvm_read joins separate acquisitions of a LabVIEW measurement file into one signal.
#
# Surprise:    LabVIEW appends each write to the file; with "one header only" nothing marks where the next write starts. lvm_read returns one signal of
#              2048 samples for two writes of 1024 that are 60 s apart. `Samples` in the header still says 1024, and the
#              time step of 0.000977 s is 1/1024 s in six decimals: after 2048 samples the time is 0.9 ms late.
# Version:     lvm_read 1.26
# Expectation: the specification of NI calls each call of "Write To Measurement File" a segment and gives `Samples` as the number of
#              samples in that segment; a reader can compare it with the rows.
# For users:   write with "one header per segment" and an X column, or compare `Samples` with the number of rows; map the rate
#              (1024) instead of the printed step.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check lvm_read==1.26 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import lvm_read
import numpy as np

print("lvm_read", version("lvm_read"))
rate, count = 1024, 1024
header = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t.
Multi_Headings\tNo
X_Columns\tNo
Time_Pref\tAbsolute
Operator\tlab
Date\t2024/05/02
Time\t10:00:00
***End_of_Header***\t
\t
Channels\t1\t
Samples\t1024\t
Date\t2024/05/02\t
Time\t10:00:00\t
Y_Unit_Label\tkN\t
X_Dimension\tTime\t
X0\t0.0000000000000000E+0\t
Delta_X\t0.000977\t
***End_of_Header***\t\t
X_Value\tForce\tComment
"""
first = np.sin(2 * np.pi * np.arange(count) / rate)
second = 50 + first  # 60 s later
with open("test.lvm", "w") as file:
    file.write(header + "".join(f"\t{value:.6f}\n" for value in np.concatenate([first, second])))
read = lvm_read.read("test.lvm", read_from_pickle=False, dump_file=False)
signal, stated = read[0]["data"][:, 0], int(read[0]["Samples"][0])
late = len(signal) * (read[0]["Delta_X"][0] - 1 / rate)
print(f"expected two segments of {stated} samples, or a warning; seen {read['Segments']} segment of {len(signal)} samples")
print(f"step between sample {count} and {count + 1}: {signal[count] - signal[count - 1]:.3f} kN; time at the end {late * 1000:.2f} ms late")
if not (read["Segments"] == 1 and len(signal) == 2 * count and stated == count and 8e-4 < late < 1e-3):
    sys.exit("The behaviour has changed.")
PY
