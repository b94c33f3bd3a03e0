#!/usr/bin/env bash
# eqsig replaces the response of every period shorter than six time steps by the record's peak.
#
# Surprise:    `eqsig.sdof.pseudo_response_spectra` returns a pseudo-acceleration equal to the peak ground acceleration for every
#              period below 6 dt, whatever the record. At resonance with a 20 Hz motion sampled at 100 Hz (T = 5 dt) it returns
#              0.95, while omega^2 times the displacement that the same function computes is above 8; displacement and velocity
#              of the returned triple keep the computed value. Neither the docstring nor the result reports this.
# Version:     eqsig 1.2.17
# Expectation: pseudo-acceleration is defined as omega^2 times the spectral displacement; a lightly damped oscillator (5 %)
#              in resonance with a harmonic motion reaches up to 1/(2 zeta) = 10 times its amplitude.
# For users:   do not scale a record to a spectrum, or judge a shaking-table motion, from eqsig's values below 6 dt. Resample the
#              record first: at 0.01 s steps everything above 16.7 Hz is affected.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check eqsig==1.2.17 numpy==2.4.6 scipy==1.17.1
"$work/venv/bin/python" -W ignore - <<'PY'
import sys

import eqsig
import numpy as np
from eqsig import sdof

print("eqsig", eqsig.__version__)
step, damping = 0.01, 0.05
motion = np.sin(2 * np.pi * 20 * np.arange(0, 10, step))
periods = np.array([0.05, 0.0599, 0.0601])
displacement, _, acceleration = sdof.pseudo_response_spectra(motion, step, periods, damping)
defined = (2 * np.pi / periods) ** 2 * displacement
peak = np.abs(motion).max()
for period, seen, right in zip(periods, acceleration, defined):
    print(f"T = {period:g} s: expected omega^2 Sd = {right:.3f}; seen Sa = {seen:.3f} (peak of the record {peak:.3f})")
if not (np.allclose(acceleration[:2], peak) and defined[0] > 8 * peak and np.isclose(acceleration[2], defined[2])):
    sys.exit("The behaviour has changed.")
PY
