#!/usr/bin/env bash
# opstool's unit `.Mg` is a milligram.
#
# Surprise:    in a unit system of kN, m and s, the unit of mass is the megagram (1000 kg), and `UnitSystem(...).Mg` is the obvious
#              name for it; its value is 1e-9, that of a milligram, because opstool ignores the case of unit names. `.MN` and
#              `.mN` are both the meganewton. A mass of `500 * unit.Mg` is 1e9 times too small, without an error.
# Version:     opstool 1.0.26
# Expectation: the SI brochure: prefixes are case-sensitive, M is 1e6 and m is 1e-3, so Mg is the megagram (the tonne).
#              opstool's documentation says that any case may be entered.
# For users:   write `.ton` (1000 kg in opstool) or `1000 * unit.kg`, and check the total mass or the first period of the model.
#              Units in plans of this program are case-sensitive.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check opstool==1.0.26 openseespy==3.7.1.2
libraries=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/openseespylinux/lib
LD_LIBRARY_PATH="$libraries" "$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

from opstool.pre import UnitSystem

print("opstool", version("opstool"))
unit = UnitSystem(length="m", force="kN", time="sec")
print(f"unit system kN, m, s (mass in 1000 kg): expected Mg = 1 and mN = 1e-6; seen Mg = {unit.Mg:g}, mN = {unit.mN:g}, "
      f"ton = {unit.ton:g}")
if not (abs(unit.Mg / 1e-9 - 1) < 1e-9 and unit.mN == unit.MN == 1000 and abs(unit.ton - 1) < 1e-9):
    sys.exit("The behaviour has changed.")
PY
