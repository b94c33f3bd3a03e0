#!/usr/bin/env bash
# scipy's NetCDF reader turns missing samples into a force.
#
# Surprise:    in a NetCDF 3 file with packed integers (scale_factor 0.01) a sample that was never written comes back as -327.67 kN
#              with `maskandscale=True`; the Unidata library gives a masked value.
# Version:     scipy 1.17.1
# Expectation: the NetCDF User's Guide defines a default fill value for each type (-32767 for 16-bit integers), used when the variable has no
#              `_FillValue`; scipy masks a value only where the attribute exists.
# For users:   set `_FillValue` when you write, or read with netCDF4; look for one equal lowest value in many places.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check scipy==1.17.1 netCDF4==1.7.5.1.post1 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import netCDF4
import numpy as np
from scipy.io import netcdf_file

print("scipy", version("scipy"), "netCDF4", version("netCDF4"))
force = np.array([5.0, 6.5, 7.0, 8.25])
with netCDF4.Dataset("test.nc", "w", format="NETCDF3_CLASSIC") as file:
    file.createDimension("time", 6)
    variable = file.createVariable("force", "i2", ("time",))
    variable.units, variable.scale_factor = "kN", 0.01
    variable[:4] = force  # samples 5 and 6 were not recorded
with netCDF4.Dataset("test.nc") as file:
    reference = file["force"][:]
with netcdf_file("test.nc", mmap=False, maskandscale=True) as file:
    read = file.variables["force"][:]
print(f"expected {reference.tolist()} kN (None: missing)")
print(f"seen     {read.tolist()} kN, largest {np.abs(read).max():.2f} kN")
right = reference.mask.tolist() == [False] * 4 + [True] * 2 and np.allclose(np.asarray(read)[:4], force)
if not (right and np.allclose(np.asarray(read)[4:], -327.67) and not np.ma.getmaskarray(read).any()):
    sys.exit("The behaviour has changed.")
PY
