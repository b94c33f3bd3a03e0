#!/usr/bin/env bash
# HELICS delivers a value one time step after it was published, so a loop of two simulators has two steps of delay.
#
# Surprise:    two federates advance together in steps of 10 ms. A value that the first federate publishes at 0.01 s reaches the
#              second federate when it is granted 0.02 s, although both are granted 0.01 s. The force that answers a displacement
#              arrives two steps later. Before the first value arrives, an input reads -1e49.
# Version:     helics 3.6.1
# Expectation: the words "publish at time t" and "granted time t" suggest that values of time t are exchanged at t. HELICS's
#              documentation offers that only on request: by iteration, or by the flag `wait_for_current_time_update` where the
#              dependence is not cyclic. A hybrid simulation is cyclic.
# For users:   in a hybrid simulation coupled by HELICS, count one step of delay for each direction as delay of the actuator, and
#              compensate for it, or use iteration. A diagnosis reports it as dead time. Give inputs a default value.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check helics==3.6.1
timeout 120 "$work/venv/bin/python" -W ignore - <<'PY'
import sys
import threading
from importlib.metadata import version

import helics

STEP, COUNT = 0.01, 6
broker = helics.helicsCreateBroker("inproc", "broker", "--federates=2")


def federate(name, publishes, reads):
    info = helics.helicsCreateFederateInfo()
    helics.helicsFederateInfoSetCoreTypeFromString(info, "inproc")
    helics.helicsFederateInfoSetCoreInitString(info, "--federates=1 --broker=broker")
    helics.helicsFederateInfoSetTimeProperty(info, helics.HELICS_PROPERTY_TIME_PERIOD, STEP)
    created = helics.helicsCreateValueFederate(name, info)
    publication = helics.helicsFederateRegisterGlobalTypePublication(created, publishes, "double", "")
    return created, publication, helics.helicsFederateRegisterSubscription(created, reads, "")


def run(parts, rows):
    created, publication, subscription = parts
    helics.helicsFederateEnterExecutingMode(created)
    for number in range(1, COUNT + 1):
        granted = helics.helicsFederateRequestTime(created, number * STEP)
        rows.append((granted, helics.helicsInputGetDouble(subscription)))
        helics.helicsPublicationPublishDouble(publication, granted)  # the value is the time of its publication
    helics.helicsFederateDisconnect(created)


pair = [federate("structure", "displacement", "force"), federate("specimen", "force", "displacement")]
tables = [[], []]
threads = [threading.Thread(target=run, args=args, daemon=True) for args in zip(pair, tables)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join(60)
helics.helicsCloseLibrary()

print("helics", version("helics"))
print("each value is the time of its publication: expected at 0.02 s the value of 0.02 s, at least once for one of the two")
ages = set()
for name, table in zip(("structure", "specimen"), tables):
    print(f"seen by the {name} (granted time, value):", [(round(t, 4), round(v, 4) if v > -1 else v) for t, v in table])
    ages |= {round((t - v) / STEP, 6) for t, v in table[1:]}
if not (ages == {1.0} and all(len(table) == COUNT and table[0][1] < -1e48 for table in tables)):
    sys.exit("The behaviour has changed.")
PY
