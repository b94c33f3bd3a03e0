#!/usr/bin/env bash
# ObsPy's Trace.resample reduces the amplitude of high frequencies, even when it resamples to a HIGHER rate.
#
# Surprise:    a 10 Hz sine of amplitude 1, recorded at 100 Hz and resampled to 200 Hz, comes out with amplitude 0.905; a 25 Hz
#              sine comes out with 0.5. The default `window='hann'` multiplies the spectrum by cos^2(pi f / fs), so every
#              frequency but zero loses amplitude. With `window=None` the amplitude stays 1.
# Version:     obspy 1.5.1
# Expectation: a band-limited signal is fully known from its samples (sampling theorem), so interpolation to a higher rate keeps
#              its amplitude. ObsPy's documentation names the default window, but not this loss of amplitude.
# For users:   pass `window=None` when you resample a record, or let the import resample it. Otherwise the record excites
#              stiff modes too weakly, and the loss looks like a filter in the actuator or the sensor.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check obspy==1.5.1 'setuptools<81'
"$work/venv/bin/python" -W ignore - <<'PY'
import sys

import numpy as np
import obspy

print("obspy", obspy.__version__)
rate, count = 100.0, 2000
time = np.arange(count) / rate
same = True
for frequency in (10.0, 25.0):
    amplitude = {}
    for window in ("default", None):
        trace = obspy.Trace(np.sin(2 * np.pi * frequency * time) * np.hanning(count), {"sampling_rate": rate})
        trace.resample(2 * rate, **({} if window == "default" else {"window": window}))
        amplitude[window] = np.abs(trace.data).max()
    law = np.cos(np.pi * frequency / rate) ** 2
    print(f"{frequency:g} Hz sine, 100 Hz to 200 Hz: expected amplitude 1; seen {amplitude['default']:.4f} by default "
          f"(cos^2(pi f/fs) = {law:.4f}), {amplitude[None]:.4f} with window=None")
    same &= abs(amplitude["default"] - law) < 0.005 and abs(amplitude[None] - 1) < 0.005
if not same:
    sys.exit("The behaviour has changed.")
PY
