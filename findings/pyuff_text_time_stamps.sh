#!/usr/bin/env bash
# In a universal file (dataset 58) that is written as text with uneven time steps, many time stamps become equal.
#
# Surprise:    300 s at 2048 Hz, written by pyuff as text with `abscissa_spacing=0`, come back with 614400 values but only
#              404801 distinct time stamps, each up to 0.5 ms off (a step is 0.488 ms), although the data type says double. The
#              values themselves keep twelve digits. With `abscissa_spacing=1` the stamps are computed from a rounded increment.
# Version:     pyuff 2.5.8
# Expectation: a reader expects "double precision" in the header to apply to both columns. The definition of dataset 58 gives only the
#              ordinate twelve decimals (E20.12); the abscissa has five (E13.5), in double precision too.
# For users:   write the binary form, or even spacing with a separate sampling rate. When you import such a text file, map the
#              rate (`rate: 2048`) instead of the time column: the import refuses a file with equal time stamps.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check pyuff==2.5.8 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
import pyuff

print("pyuff", version("pyuff"))
rate, count = 2048, 300 * 2048
time = np.arange(count) / rate
data = np.sin(time)
pyuff.UFF("test.uff").write_sets(
    {
        "type": 58, "binary": 0, "func_type": 1, "id1": "test", "rsp_node": 1, "rsp_dir": 1, "ref_node": 1, "ref_dir": 1,
        "data": data, "x": time, "num_pts": count, "abscissa_spacing": 0, "abscissa_min": 0.0, "abscissa_inc": 1 / rate,
        "abscissa_spec_data_type": 17, "ordinate_spec_data_type": 8, "orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0,
        "ord_data_type": 4, "ver_num": 1, "load_case_id": 1, "z_axis_value": 0, "rsp_ent_name": "point", "ref_ent_name": "point",
    },
    mode="overwrite",
)
read = pyuff.UFF("test.uff").read_sets(0)
distinct, error = len(np.unique(read["x"])), np.abs(read["x"] - time).max()
print(f"expected {count} distinct time stamps, as in the array written")
print(f"seen {distinct}, up to {error * 1000:.3f} ms off (one step: {1000 / rate:.3f} ms); "
      f"values up to {np.abs(read['data'] - data).max():.1e} off")
if not (len(read["x"]) == count and distinct == 404801 and error > 1 / rate and np.abs(read["data"] - data).max() < 1e-11):
    sys.exit("The behaviour has changed.")
PY
