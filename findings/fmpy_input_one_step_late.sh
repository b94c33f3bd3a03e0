#!/usr/bin/env bash
# FMPy's recorded input of a co-simulation is one communication step late, and so is the output.
#
# Surprise:    `simulate_fmu` applies the input of time t before the step from t to t + h, and writes input and output at t + h.
#              For a unit whose output equals its input (y = u), the row of 0.2 s holds u = y = 0.1 for the ramp u(t) = t. Since the
#              recorded input is shifted too, plotting y against u shows no delay; only the original signal does.
# Version:     FMPy 0.3.32, with PythonFMU 0.7.0 that builds the unit
# Expectation: a result table's row of time t shows the input signal given for time t. FMI 2.0 (co-simulation) holds inputs constant
#              during a communication step unless derivatives are set, so the delay itself follows the standard.
# For users:   compare with the signal that you gave, not with the recorded input; with the default (500 steps a run) the delay is
#              1/500 of the duration. A diagnosis of a recording made in this way reports a dead time of one step.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check FMPy==0.3.32 pythonfmu==0.7.0 numpy==2.4.6
cd "$work"
cat > pass_through.py <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class PassThrough(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u = self.y = 0.0
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.y = self.u
        return True
PY
"$work/venv/bin/pythonfmu" build -f pass_through.py > build.log 2>&1 || { cat build.log >&2; exit 1; }
timeout 120 "$work/venv/bin/python" -W ignore - <<'PY'
import sys

import fmpy
import numpy as np

print("FMPy", fmpy.__version__)
step = 0.1
time = np.arange(0, 1.001, 0.01)
ramp = np.array(list(zip(time, time)), dtype=[("time", float), ("u", float)])
table = fmpy.simulate_fmu("PassThrough.fmu", stop_time=1.0, output_interval=step, input=ramp, output=["u", "y"])
print("y = u for the ramp u(t) = t: expected u = y = t in each row")
print("seen:", [tuple(round(float(value), 6) for value in row) for row in table[:4]], "... as (t, u, y)")
late = table["time"][1:] - step
if not (np.allclose(table["u"][1:], late, atol=1e-9) and np.allclose(table["y"][1:], late, atol=1e-9)):
    sys.exit("The behaviour has changed.")
PY
