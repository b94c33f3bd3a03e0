#!/usr/bin/env bash
# fatpack's rainflow count rounds every reversal to 64 classes, so small cycles change their size or are lost.
#
# Surprise:    `find_rainflow_ranges(y)` first puts the signal into k = 64 classes between its minimum and maximum. Beside one
#              cycle of +-100, five cycles of +-10 (range 20) are counted with range 18.75, and five of +-1 are not counted at all.
# Version:     fatpack 0.7.8
# Expectation: ASTM E1049 counts the exact ranges between successive peaks and valleys. Classes are a later step, for a table of
#              the result. The docstring mentions k, but a reader can take it for the number of classes of the output.
# For users:   give `k` so large that (max - min) / k is below the smallest cycle that matters, or count displacement cycles of a
#              damper with a program that works on the reversals themselves.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check fatpack==0.7.8 numpy==2.4.6
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import fatpack
import numpy as np

print("fatpack", version("fatpack"))
time = np.linspace(0, 1, 2001)
same = True
for amplitude, seen_ranges in ((10.0, [18.75] * 5 + [200.0]), (1.0, [200.0])):
    signal = np.concatenate([amplitude * np.sin(2 * np.pi * 5 * time), 100 * np.sin(2 * np.pi * time)])
    seen = np.sort(fatpack.find_rainflow_ranges(signal))
    fine = np.sort(fatpack.find_rainflow_ranges(signal, k=20000))
    print(f"5 cycles of +-{amplitude:g} and one of +-100: expected ranges {[2 * amplitude] * 5 + [200.0]}; "
          f"seen {seen.tolist()} by default, {np.round(fine, 2).tolist()} with k=20000")
    same &= np.allclose(seen, seen_ranges) if len(seen) == len(seen_ranges) else False
    same &= np.allclose(fine, [2 * amplitude] * 5 + [200.0], atol=0.02)
if not same:
    sys.exit("The behaviour has changed.")
PY
