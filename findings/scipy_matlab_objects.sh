#!/usr/bin/env bash
# scipy.io.loadmat keeps one of several MATLAB tables, strings or times, and loses the names of all.
#
# Surprise:    a MAT file (version 7) with three objects beside two arrays gives the arrays and one entry with the key 'None': each object
#              replaces the one before. `whosmat` fails with a TypeError. No warning says that two variables are missing.
# Version:     scipy 1.17.1, mat-io 1.0.2 (writes the file)
# Expectation: scipy documents that it cannot read objects of MATLAB's newer classes; a list of the variables, or an error, is expected.
# For users:   save arrays (`t = seconds(tt.Time); F = tt.Force;`), or read with mat-io; compare the number of variables with MATLAB's `whos`.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check scipy==1.17.1 mat-io==1.0.2 pandas==3.1.1 h5py==3.16.0 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import matio
import numpy as np
import pandas as pd
import scipy.io

print("scipy", version("scipy"), "mat-io", version("mat-io"))
time = np.arange(5) / 100
written = {
    "t": time.reshape(1, -1),
    "force": np.sin(time).reshape(1, -1),
    "test_a": pd.DataFrame({"Force": np.arange(5.0)}),
    "test_b": pd.DataFrame({"Force": 10 * np.arange(5.0)}),
    "test_c": pd.DataFrame({"Force": 100 * np.arange(5.0)}),
}
matio.save_to_mat("test.mat", written, version="v7")
whole = sorted(name for name in matio.load_from_mat("test.mat") if not name.startswith("__"))
read = sorted(str(name) for name in scipy.io.loadmat("test.mat") if not str(name).startswith("__"))
try:
    listed = [entry[0] for entry in scipy.io.whosmat("test.mat")]
except TypeError as error:
    listed = f"TypeError: {error}"
print(f"expected {whole}")
print(f"seen {read}; whosmat: {listed}")
if not (whole == sorted(written) and read == ["None", "force", "t"] and str(listed).startswith("TypeError")):
    sys.exit("The behaviour has changed.")
PY
