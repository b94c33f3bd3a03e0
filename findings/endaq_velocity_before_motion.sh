#!/usr/bin/env bash
# endaq-calc's integral of an acceleration has a velocity before the motion starts.
#
# Surprise:    `integrals` subtracts the mean of each integral. A table at rest that is accelerated with 1 m/s^2 from 0.5 s to
#              0.7 s gets a velocity of -0.14 m/s while it is at rest, and +0.06 m/s afterwards instead of 0.2 m/s. No argument
#              turns this off, and the documentation of the function does not mention it.
# Version:     endaq-calc 1.1.0.post2
# Expectation: the integral from the start of the record, zero where the record begins at rest, as the cumulative trapezoid rule
#              (which the documentation refers to) gives it.
# For users:   shift the velocity so that it is zero while the specimen is at rest, and integrate the shifted velocity for the
#              displacement: without the shift, the subtracted mean becomes a slope of the displacement. Or import the
#              acceleration only.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check endaq-calc==1.1.0.post2 numpy==2.4.6 pandas==3.1.1
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
import pandas as pd
from endaq.calc import integrate

print("endaq-calc", version("endaq-calc"))
time = np.arange(0, 2, 0.001)
acceleration = pd.DataFrame({"a": np.where((time > 0.5) & (time < 0.7), 1.0, 0.0)}, index=pd.Index(time, name="time"))
velocity = integrate.integrals(acceleration, n=1)[1]["a"].to_numpy()
rest, end = velocity[time < 0.5], velocity[-1]
print("1 m/s^2 from 0.5 s to 0.7 s: expected velocity 0 before, 0.2 m/s after")
print(f"seen: {rest[0]:.4f} m/s before (constant: {np.ptp(rest) < 1e-12}), {end:.4f} m/s after, mean {velocity.mean():.1e} m/s")
if not (np.ptp(rest) < 1e-12 and rest[0] < -0.1 and abs(end - rest[0] - 0.199) < 1e-6 and abs(velocity.mean()) < 1e-9):
    sys.exit("The behaviour has changed.")
PY
