#!/usr/bin/env bash
# asammdf's data frame contains a force at times when no force was recorded.
#
# Surprise:    `MDF.to_dataframe` brings channels of different groups onto one time base, and fills the times before a channel's
#              first sample with that sample, and the times after its last sample with the last sample. A force recorded from 10 s
#              to 15 s of a 20 s test has values from 0 s to 20 s. `interpolate_outwards_with_nan=True` leaves these times empty.
# Version:     asammdf 8.8.28
# Expectation: the MDF standard of ASAM gives each channel group a time channel of its own; outside it no value was measured, and
#              a data frame has NaN for that. asammdf's documentation lists the option, off by default.
# For users:   export with `interpolate_outwards_with_nan=True`. Otherwise the import sees no gap, and a model is compared with a
#              force that was not measured.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check asammdf==8.8.28 pandas==3.1.1 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys

import asammdf
import numpy as np

print("asammdf", asammdf.__version__)
slow, fast = np.arange(10, 15, 1 / 256), np.arange(0, 20, 1 / 1024)
with asammdf.MDF(version="4.10") as file:
    file.append([asammdf.Signal(np.sin(fast), fast, name="displacement", unit="mm")])
    file.append([asammdf.Signal(5 + np.sin(slow), slow, name="force", unit="kN")])
    file.save("test.mf4", overwrite=True)
with asammdf.MDF("test.mf4") as file:
    frame = file.to_dataframe()
    honest = file.to_dataframe(interpolate_outwards_with_nan=True)

first, last = 5 + np.sin(slow[0]), 5 + np.sin(slow[-1])
missing, right = int(frame["force"].isna().sum()), int(honest["force"].isna().sum())
print(f"force measured from 10 s to 15 s of 20 s: expected about {15 * 1024} rows without a force")
print(f"seen: {missing} by default, {right} with interpolate_outwards_with_nan=True; "
      f"force at 0 s: {frame['force'].iloc[0]:.4f} kN, at 20 s: {frame['force'].iloc[-1]:.4f} kN")
held = np.allclose(frame["force"][:9.99], first) and np.allclose(frame["force"][15.0:], last)
if not (missing == 0 and held and abs(right - 15 * 1024) < 10):
    sys.exit("The behaviour has changed.")
PY
