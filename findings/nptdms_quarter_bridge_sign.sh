#!/usr/bin/env bash
# npTDMS turns a positive voltage of a quarter bridge into a negative strain.
#
# Surprise:    a channel of a TDMS file with NI's strain scaling (quarter bridge I) and a reading of +5 mV comes out as
#              -0.00199 strain, compression by the usual sign, and -5 mV as +0.00201. The size is not symmetric either: the
#              bridge is not linear. A linear factor, voltage times 4 / (gauge factor times excitation), gives +0.002 for both.
# Version:     npTDMS 1.13.0
# Expectation: the common formula for a small strain, U/U_exc = k * strain / 4, is positive in tension. National Instruments
#              defines its bridges with the opposite sign; its scaling, which npTDMS follows, has a minus sign for this.
# For users:   the voltage and the strain of the same gauge differ in sign. When you import a file without the scaling
#              (`raw_data`, or with your own factor), set `reverse: true` in the mapping, and check the sign with a known load.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check npTDMS==1.13.0 numpy==2.4.6
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
from importlib.metadata import version

import numpy as np
from nptdms import ChannelObject, TdmsFile, TdmsWriter

QUARTER_BRIDGE_1, GAUGE_FACTOR, EXCITATION = 10271, 2.0, 5.0
strain_scale = {
    "Scale_Type": "Strain",
    "Strain_Configuration": QUARTER_BRIDGE_1,
    "Strain_Poisson_Ratio": 0.3,
    "Strain_Gage_Resistance": 350.0,
    "Strain_Lead_Wire_Resistance": 0.0,
    "Strain_Initial_Bridge_Voltage": 0.0,
    "Strain_Gage_Factor": GAUGE_FACTOR,
    "Strain_Bridge_Shunt_Calibration_Gain_Adjustment": 1.0,
    "Strain_Voltage_Excitation": EXCITATION,
    "Strain_Input_Source": 0xFFFFFFFF,
}
properties = {"NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1}
properties |= {f"NI_Scale[0]_{key}": value for key, value in strain_scale.items()}
volts = np.array([0.0, 0.005, -0.005])
with TdmsWriter("bridge.tdms") as writer:
    writer.write_segment([ChannelObject("test", "gauge", volts, properties)])

print("npTDMS", version("npTDMS"))
channel = TdmsFile.read("bridge.tdms")["test"]["gauge"]
strain, linear = channel[:], 4 * volts / (GAUGE_FACTOR * EXCITATION)
ratio = volts / EXCITATION
law = -4 * ratio / (GAUGE_FACTOR * (1 + 2 * ratio))
print(f"volts in the file: {channel.raw_data.tolist()}")
print(f"expected with tension positive: {np.round(linear, 6).tolist()}; seen: {np.round(strain, 6).tolist()}")
if not (np.allclose(strain, law, atol=1e-12) and strain[1] < 0 < strain[2]):
    sys.exit("The behaviour has changed.")
PY
