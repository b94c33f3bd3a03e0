#!/usr/bin/env bash
# ObsPy reads a K-NET record as counts, and keeps the factor `calib` after it has applied this factor.
#
# Surprise:    `obspy.read` returns the digitiser's counts of a K-NET file, although the header holds the scale factor to gal and
#              ObsPy has turned it into `stats.calib` (m/s^2 per count). `read(..., apply_calib=True)` returns m/s^2, but
#              `stats.calib` still holds the factor, so code that multiplies by `calib` scales the record twice.
# Version:     obspy 1.5.1
# Expectation: the format of NIED defines acceleration in gal as count times the header's scale factor; the header's
#              "Max. Acc. (gal)" allows a check. After a factor has been applied, it should be 1.
# For users:   read with `apply_calib=True`, import the result as m/s^2, and never multiply it by `stats.calib`. Check the peak
#              against "Max. Acc. (gal)" of the header (1 gal = 0.01 m/s^2). Remove the mean: the counts carry an offset.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check obspy==1.5.1 'setuptools<81'
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys

import numpy as np
import obspy

PEAK_GAL, FULL_SCALE_GAL, FULL_SCALE_COUNTS = 100.0, 7845, 8223790
counts = np.rint(PEAK_GAL * FULL_SCALE_COUNTS / FULL_SCALE_GAL * np.sin(np.arange(3000) * 2 * np.pi / 200)).astype(int)
header = f"""\
Origin Time       2000/01/01 00:00:00
Lat.              35.000
Long.             135.000
Depth. (km)       10
Mag.              6.0
Station Code      ABC001
Station Lat.      35.1000
Station Long.     135.1000
Station Height(m) 40
Record Time       2000/01/01 00:00:15
Sampling Freq(Hz) 100Hz
Duration Time(s)  30
Dir.              N-S
Scale Factor      {FULL_SCALE_GAL}(gal)/{FULL_SCALE_COUNTS}
Max. Acc. (gal)   {PEAK_GAL}
Last Correction   2000/01/01 00:00:15
Memo.
"""
with open("ABC0010001010000.NS", "w") as file:
    file.write(header)
    for start in range(0, len(counts), 8):
        file.write("".join(f"{count:9d}" for count in counts[start : start + 8]) + "\n")

print("obspy", obspy.__version__)
plain = obspy.read("ABC0010001010000.NS")[0]
scaled = obspy.read("ABC0010001010000.NS", apply_calib=True)[0]
print(f"expected peak: {PEAK_GAL / 100:g} m/s^2, and a factor of 1 once it is applied")
print(f"seen: read() gives {plain.max():.0f} with calib {plain.stats.calib:.4g}; "
      f"read(apply_calib=True) gives {scaled.max():.4f} with calib {scaled.stats.calib:.4g}")
print(f"seen: applied once more, the peak is {scaled.max() * scaled.stats.calib:.3g} m/s^2")
if not (abs(plain.max() - counts.max()) < 0.5 and abs(scaled.max() - 1) < 1e-3 and scaled.stats.calib == plain.stats.calib < 1e-4):
    sys.exit("The behaviour has changed.")
PY
