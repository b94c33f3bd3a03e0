#!/usr/bin/env bash
# An analogue output record cuts a value beyond its drive limits, and tells the client of a success.
#
# Surprise:    With DRVH = 50 and DRVL = -50, a put of 1000 with completion stores 50 and reports success: the client goes on as if the
#              device had been told 1000.
# Version:     softioc 4.7.2, aioca 2.1 (EPICS base 7.0 of epicscorelibs)
# Expectation: a client learns that its value was refused or changed.
# For users:   compare DRVH and DRVL with the limits of the test before it starts, as this program does, and
#              read a command back.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check softioc==4.7.2 aioca==2.1 numpy==2.4.6
cd "$work"
cat > ioc.py <<'PY'
import sys

from softioc import asyncio_dispatcher, builder, softioc

dispatcher = asyncio_dispatcher.AsyncioDispatcher()
builder.SetDeviceName("RIG")
device = builder.aIn("DEVICE", initial_value=0.0)
builder.aOut("COMMAND", initial_value=0.0, DRVH=50, DRVL=-50, on_update=device.set, always_update=True, blocking=True)
builder.LoadDatabase()
softioc.iocInit(dispatcher)
print("ready", flush=True)
sys.stdin.read()
PY
cat > client.py <<'PY'
import asyncio
import os
import socket
import subprocess
import sys
from importlib.metadata import version

with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as two:
    one.bind(("127.0.0.1", 0))
    two.bind(("127.0.0.1", 0))
    ports = one.getsockname()[1], two.getsockname()[1]
names = ("EPICS_CA_ADDR_LIST", "EPICS_CAS_INTF_ADDR_LIST", "EPICS_CAS_BEACON_ADDR_LIST", "EPICS_PVAS_INTF_ADDR_LIST")
os.environ.update(dict.fromkeys(names, "127.0.0.1"), EPICS_CA_AUTO_ADDR_LIST="NO")
os.environ.update(EPICS_CA_SERVER_PORT=str(ports[0]), EPICS_CA_REPEATER_PORT=str(ports[1]))
ioc = subprocess.Popen([sys.executable, "ioc.py"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
while ioc.stdout.readline().strip() != "ready":
    pass
import aioca


async def main():
    answer = await aioca.caput("RIG:COMMAND", 1000.0, wait=True)
    seen = bool(answer), float(await aioca.caget("RIG:COMMAND")), float(await aioca.caget("RIG:DEVICE"))
    aioca.purge_channel_caches()
    return seen


seen = asyncio.run(main())
ioc.kill()
print("softioc", version("softioc"), "aioca", version("aioca"), "epicscorelibs", version("epicscorelibs"))
print("expected with drive limits of ±50: a put of 1000 is refused, or the client learns of the change")
print(f"seen: put 1000: success {seen[0]}, record {seen[1]:g}, device {seen[2]:g}")
if seen != (True, 50.0, 50.0):
    sys.exit("The behaviour has changed.")
PY
timeout 120 "$work/venv/bin/python" -W ignore client.py
