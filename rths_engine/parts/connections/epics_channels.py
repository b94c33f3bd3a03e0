"""The channels of an EPICS connection: Channel Access through aioca, whose event loop has a thread of its own.

Channel Access binds its channels to the thread that opened them, so every call of an adapter hands its work to that thread.
"""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Coroutine
from typing import Any, ClassVar, TypeVar

from rths_engine.foundation import units
from rths_engine.parts.connections.connection import Adapter, Lost, Reading, RigError, Terms
from rths_engine.parts.connections.epics_variables import ProcessVariables
from rths_engine.parts.connections.optional import package

# chosen; see docs/decisions/0023
OPENING_S = 5.0  # to find all process variables
SLACK = 1 - 1e-9  # of a limit: rounding of its conversion
INVALID = 3  # severity of an alarm, by definition: the value is not valid
T = TypeVar("T")


class EpicsRig(Adapter):
    """The process variables of one station."""

    _opened: ClassVar[set[int]] = set()  # rigs whose channels are open; aioca closes all channels of the process at once

    def __init__(self, connection: ProcessVariables, terms: Terms):
        self.given, self.terms, self.scale = connection, terms, connection.scale
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True, name="rths-epics")
        self._latest: dict[str, Any] = {}  # of monitored variables, by name
        self._monitors: list[Any] = []
        self._put: asyncio.Future[Any] | None = None
        self._step = 0

    def open(self) -> Reading:
        self._ca = package("aioca", "epics", self.terms)
        EpicsRig._opened.add(id(self))
        self._thread.start()
        try:
            return self._wait(self._connect(), OPENING_S + self.given.patience)
        except (RigError, KeyboardInterrupt):
            self.close()
            raise
        except (Lost, self._ca.CANothing) as error:
            self.close()
            raise self.terms.refused("command", f"the rig does not answer: {error}", self.given.command) from None

    def command(self, displacement: float, current: float, time: float) -> None:
        self._wait(self._send(displacement / self.scale.displacement, current), self.given.patience)

    def measure(self) -> Reading:
        reading = self._wait(self._measured(), self.given.patience)
        self._check_permit()
        return reading

    def close(self) -> None:
        """The records keep the last command: an IOC holds it until another is put."""
        if not self._thread.is_alive():
            return
        EpicsRig._opened.discard(id(self))
        with contextlib.suppress(Exception):
            asyncio.run_coroutine_threadsafe(self._leave(), self._loop).result(OPENING_S)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(OPENING_S)
        if not self._thread.is_alive():
            self._loop.close()

    async def _leave(self) -> None:
        for monitor in self._monitors:
            monitor.close()
        if not EpicsRig._opened:
            self._ca.purge_channel_caches()
        pending = asyncio.all_tasks() - {asyncio.current_task()}
        for task in pending:
            task.cancel()
        if pending:
            await asyncio.wait(pending)

    async def _connect(self) -> Reading:
        given, ca = self.given, self._ca
        named = {
            field: getattr(given, field) for field in type(given).model_fields if field in PLACES and getattr(given, field)
        }
        found = await ca.connect(list(named.values()), timeout=OPENING_S, throw=False)
        for field, answer in zip(named, found, strict=True):
            if not answer.ok:
                fix = "start its IOC, and check EPICS_CA_ADDR_LIST in the environment of the worker"
                raise self.terms.refused(field, f"no IOC answers within {OPENING_S:g} s", named[field], fix)
        for field in named:
            await self._compare(field, named[field])
        watched = [name for name in (given.permit, given.echo) if name]
        watched += [given.displacement, given.force] if given.reading == "monitor" else []
        self._news = asyncio.Event()
        for name in watched:
            monitor = ca.camonitor(name, self._noting(name), format=ca.FORMAT_TIME, notify_disconnect=True)
            self._monitors.append(monitor)
        while len(self._latest) < len(set(watched)):
            await self._next()
        if given.permit and not self._latest[given.permit]:
            raise self.terms.refused(
                "permit", "is 0: the rig does not permit a test", given.permit, "give the permit at the rig"
            )
        return await self._got()

    async def _compare(self, field: str, name: str) -> None:
        """Compare the unit, the drive limits and the access of a record with the plan. Raises RigError."""
        given, terms, ca = self.given, self.terms, self._ca
        if field in WRITTEN and not (await ca.cainfo(name)).write:
            raise terms.refused(field, "cannot be written: the IOC refuses it", name, "check the access rules of the IOC")
        if field not in UNIT_OF:
            return
        planned = getattr(given, UNIT_OF[field]) if UNIT_OF[field] else "A"
        record = await ca.caget(name, format=ca.FORMAT_CTRL)
        written = str(getattr(record, "units", "")).strip()
        known = units.named(written) if written else planned
        if known is None or units.UNITS[known] != units.UNITS[planned]:
            problem = f"is in {written} (EGU), but the plan gives {planned}"
            raise terms.refused(field, problem, name, "change the unit in the plan")
        low, high = float(record.lower_ctrl_limit), float(record.upper_ctrl_limit)
        reach = terms.displacement_limit / abs(self.scale.displacement)
        if field == "command" and high > low and not (low <= -reach * SLACK and high >= reach * SLACK):
            record_takes = f"takes {low:g} to {high:g} {planned} (DRVL, DRVH) and cuts what is beyond"
            fix = "lower the displacement limit of the station, or widen the record's"
            raise terms.refused(field, f"{record_takes}, but the plan allows ±{reach:g} {planned}", name, fix)

    async def _send(self, x: float, current: float) -> None:
        given, ca = self.given, self._ca
        self._step += 1
        if given.current:
            await ca.caput(given.current, current, timeout=None)
        if given.reading == "get":
            self._put = asyncio.ensure_future(ca.caput(given.command, x, wait=True, timeout=None))
            await asyncio.sleep(0)  # the put goes out now
        else:
            await ca.caput(given.command, x, timeout=None)
        if given.heartbeat:
            await ca.caput(given.heartbeat, self._step, timeout=None)

    async def _measured(self) -> Reading:
        given = self.given
        if self._put is not None:
            await self._put
            self._put = None
        while given.echo and self._value(given.echo) != self._step:
            await self._next()
        if given.reading == "get":
            return await self._got()
        return self._reading(self._value(given.displacement), self._value(given.force))

    async def _got(self) -> Reading:
        given, ca = self.given, self._ca
        pair = [given.displacement, given.force]
        return self._reading(*await ca.caget(pair, format=ca.FORMAT_TIME, timeout=None))

    def _reading(self, x: Any, f: Any) -> Reading:
        for name, value in ((self.given.displacement, x), (self.given.force, f)):
            if value.severity >= INVALID:
                raise Lost(f"{name} has an alarm: its value is INVALID")
        return Reading(float(x) * self.scale.displacement, float(f) * self.scale.force)

    def _noting(self, name: str) -> Any:
        def note(value: Any) -> None:
            self._latest[name] = value
            self._news.set()

        return note

    def _value(self, name: str) -> Any:
        """The latest value of a monitored variable. Raises Lost when it is disconnected."""
        value = self._latest[name]
        if getattr(value, "ok", True) is False or isinstance(value, Exception):
            raise Lost(f"{name} is disconnected")
        return value

    def _check_permit(self) -> None:
        if self.given.permit and not self._value(self.given.permit):
            raise Lost(f"it withdrew its permit ({self.given.permit})")

    async def _next(self) -> None:
        self._news.clear()
        await self._news.wait()

    def _wait(self, awaited: Coroutine[Any, Any, T], patience: float) -> T:
        """The result of the awaited in the thread of the loop. Raises Lost after `patience` (s) and when a channel fails."""
        future = asyncio.run_coroutine_threadsafe(awaited, self._loop)
        try:
            return future.result(patience)
        except TimeoutError:
            future.cancel()
            raise Lost(f"it did not answer within {patience:g} s") from None
        except self._ca.CANothing as error:
            raise Lost(str(error)) from None


PLACES = ("command", "displacement", "force", "current", "permit", "heartbeat", "echo")
WRITTEN = ("command", "current", "heartbeat")
UNIT_OF = {"command": "displacement_unit", "displacement": "displacement_unit", "force": "force_unit", "current": ""}
"""Field with a physical value -> the field of the connection with its unit; empty: A."""
