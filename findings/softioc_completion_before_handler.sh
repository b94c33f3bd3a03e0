#!/usr/bin/env bash
# A put that waits for completion returns before the handler of a softioc record has run.
#
# Surprise:    `caput(..., wait=True)` of Channel Access reports that the record was processed. With softioc's default the handler
#              `on_update` is only scheduled then. A rig that moves and measures in its handler still shows the readings of the
#              command before, with severity NO_ALARM and status success; nothing marks them as old.
# Version:     softioc 4.7.2, aioca 2.1 (EPICS base 7.0 of epicscorelibs)
# Expectation: after a put with completion, a get of another record of the same rig shows the effect of the put.
# For users:   give the record `blocking=True`, or let the rig copy the number of a step into a record after it has measured, and
#              wait for that number. This program does so with the fields heartbeat and echo.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check softioc==4.7.2 aioca==2.1 numpy==2.4.6
cd "$work"
cat > ioc.py <<'PY'
import sys
import time

from softioc import asyncio_dispatcher, builder, softioc

dispatcher = asyncio_dispatcher.AsyncioDispatcher()
builder.SetDeviceName("RIG")


def command(name, reading, **more):
    def moved(value):
        time.sleep(0.5)  # the rig moves, then it measures
        reading.set(value)

    builder.aOut(name, initial_value=0.0, on_update=moved, **more)


command("COMMAND", builder.aIn("READING", initial_value=0.0))
command("BLOCKING", builder.aIn("BLOCKED", initial_value=0.0), blocking=True)
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
    await aioca.caput("RIG:COMMAND", 7.0, wait=True)
    at_once = await aioca.caget("RIG:READING", format=aioca.FORMAT_TIME)
    await asyncio.sleep(1.5)
    later = await aioca.caget("RIG:READING")
    await aioca.caput("RIG:BLOCKING", 7.0, wait=True)
    blocked = await aioca.caget("RIG:BLOCKED")
    aioca.purge_channel_caches()
    return float(at_once), at_once.severity, float(later), float(blocked)


seen = asyncio.run(main())
ioc.kill()
print("softioc", version("softioc"), "aioca", version("aioca"))
print("expected after a put of 7 with completion: a reading of 7")
print(f"seen: {seen[0]:g} with severity {seen[1]}; a second later {seen[2]:g}; of a record with blocking=True {seen[3]:g}")
if seen != (0.0, 0, 7.0, 7.0):
    sys.exit("The behaviour has changed.")
PY
timeout 120 "$work/venv/bin/python" -W ignore client.py
