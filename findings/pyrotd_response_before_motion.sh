#!/usr/bin/env bash
# pyRotd's oscillator moves before the ground does if the record ends during strong motion.
#
# Surprise:    the response is computed as a product of Fourier spectra without padding, so the response after the end of the
#              record appears at its start. With a pulse in the last 0.5 s of a 20 s record, the 1 Hz oscillator
#              already moves at time zero, and that motion gives the spectrum's value.
# Version:     pyRotd 0.6.1
# Expectation: the response of a resting oscillator is zero until the ground moves (causality); a product of discrete spectra is
#              a circular convolution, so the record needs zeros at its end, until the response has decayed.
# For users:   append zeros to a record before you pass it to pyRotd (for damping zeta and period T at least T/zeta), above all
#              to records that end at the end of a trigger, and to repeated motions of a shaking table.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check pyRotd==0.6.1 numpy==2.4.6 'setuptools<81'
"$work/venv/bin/python" -W ignore - <<'PY'
import sys

import numpy as np
import pyrotd

print("pyRotd", pyrotd.__version__)
step, count, pulse = 0.01, 2000, 50
motion = np.zeros(count)
motion[-pulse:] = np.sin(2 * np.pi * np.arange(pulse) / pulse)


def response(record):
    frequency = np.fft.rfftfreq(len(record), step)
    return pyrotd.calc_oscillator_resp(frequency, np.fft.rfft(record), 0.02, 1.0)


plain, padded = response(motion), response(np.concatenate([motion, np.zeros(20000)]))
quiet = slice(0, count - pulse - 1)
early, right = np.abs(plain[quiet]).max(), np.abs(padded[quiet]).max()
during = np.abs(plain[-pulse:]).max()
print("expected: no response in the 19.5 s before the ground moves")
print(f"seen: up to {early:.3f} g before, {during:.3f} g during the pulse; with 200 s of zeros behind it, {right:.1e} g before")
if not (early > during > 0.5 and right < 1e-3):
    sys.exit("The behaviour has changed.")
PY
