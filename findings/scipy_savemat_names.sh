#!/usr/bin/env bash
# scipy.io.savemat writes variables under names that MATLAB cannot use, without a warning.
#
# Surprise:    `savemat` checks names of variables for a leading underscore only. `x_cmd.1`, `1st`, `end` and a name of 70 characters are
#              written as they are; MATLAB takes letters, digits and underscores, at most 63 of them, and no keyword. Fields of structs are
#              checked otherwise: those of more than 31 characters are an error, those with a dot are written. A variable of 2 to 4 GB is
#              written too: the writer stops at 2^32 bytes, MATLAB at 2^31.
# Version:     scipy 1.17.1
# Expectation: an error, or the warning that a leading underscore and a digit at the start of a field give.
# For users:   rename before you save (`re.sub(r"\W", "_", name)`), keep names to 31 characters, and write HDF5 from 2 GB on.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check scipy==1.17.1 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W error - <<'PY'
import inspect
import io
import sys

import numpy as np
import scipy
from scipy.io import savemat, whosmat
from scipy.io.matlab import _mio5

print("scipy", scipy.__version__)
names = ["x_cmd.1", "1st", "end", "v" * 70]
file = io.BytesIO()
savemat(file, {name: np.arange(3.0) for name in names})  # no warning: warnings are errors here
file.seek(0)
written = [name for name, _, _ in whosmat(file)]
print(f"expected an error or a warning for each of {names}")
print(f"seen {written}, without a warning")
refused = 0
try:
    savemat(io.BytesIO(), {"s": {"f" * 32: 1.0}})
except ValueError as error:
    refused = 1
    print(f"a field of 32 characters: {error}")
bound = "2**32" in inspect.getsource(_mio5.VarWriter5.update_matrix_tag)
print(f"largest variable that is written: {'2**32' if bound else 'other'} bytes; MATLAB loads 2**31")
if not (sorted(written) == sorted(names) and refused and bound):
    sys.exit("The behaviour has changed.")
PY
