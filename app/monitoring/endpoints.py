"""REST endpoints for monitoring. They use no thread and no connection of other requests."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import chain
from typing import TypeVar

from fastapi import APIRouter, Request, Response
from prometheus_client import CONTENT_TYPE_LATEST, generate_latest
from prometheus_client.registry import Collector
from sqlalchemy.exc import SQLAlchemyError

from app import metrics, openapi
from app.access import ANYONE, Role, allowed
from app.gate import person_of
from app.monitoring import checks
from app.monitoring.schemas import Readiness

router = APIRouter(tags=["health"])
WITHIN_S = 3.0
KEPT_S = 5.0  # for which a look at the checks serves every probe: the look writes a file to the store
Found = TypeVar("Found")


class Monitor:
    """The threads of monitoring, the collector of the application, and the last look at the checks."""

    def __init__(self, collected: Collector):
        self.collected = collected
        self._threads = ThreadPoolExecutor(2, thread_name_prefix="rths-monitor")
        self._looking: asyncio.Future[Readiness] | None = None
        self._looked_at = -KEPT_S

    async def ask(self, look: Callable[[], Found]) -> Found:
        """Look in a thread of monitoring. Raises TimeoutError."""
        return await asyncio.wait_for(asyncio.get_running_loop().run_in_executor(self._threads, look), WITHIN_S)

    async def ready(self, look: Callable[[], Readiness]) -> Readiness:
        """What the checks say. Probes within KEPT_S, also those at the same time, share one look."""
        if self._looking is None or (self._looking.done() and time.monotonic() - self._looked_at >= KEPT_S):
            self._looking = asyncio.ensure_future(self._look(look))
        return await asyncio.shield(self._looking)

    async def _look(self, look: Callable[[], Readiness]) -> Readiness:
        try:
            return await self.ask(look)
        except TimeoutError:
            return checks.silent(WITHIN_S)
        finally:
            self._looked_at = time.monotonic()

    def text(self) -> bytes:
        return generate_latest(_Both(self.collected))

    def close(self) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)


class _Both:
    """The metrics of this process, and what is read when asked for."""

    def __init__(self, collected: Collector):
        self.collected = collected

    def collect(self):  # type: ignore[no-untyped-def]
        return chain(metrics.REGISTRY.collect(), self.collected.collect())


@router.get("/readyz", responses={503: {"model": Readiness, "description": "Something that the service needs is missing"}})
@allowed(ANYONE)
async def ready(request: Request, response: Response) -> Readiness:
    """Report whether the service can accept and execute tests: 200 when it is ready, else 503.

    Who is signed in also reads the reason of each check; other people read only the names of the checks that failed.
    """
    state = request.app.state
    monitor: Monitor = state.monitor
    found = await monitor.ready(lambda: checks.readiness(state.settings, state.sessions))
    response.status_code = 200 if found.ready else 503
    return found if await _signed_in(request) else found.without_reasons()


async def _signed_in(request: Request) -> bool:
    try:
        return await person_of(request.scope, request.app.state.settings, remembered=True) is not None
    except SQLAlchemyError:
        return False


@router.get("/metrics", response_class=Response, responses=openapi.file("text/plain"))
@allowed(Role.VIEWER)
async def prometheus(request: Request) -> Response:
    """Report the metrics of this process, of the workers and of the database in the text form of Prometheus."""
    monitor: Monitor = request.app.state.monitor
    try:
        return Response(await monitor.ask(monitor.text), media_type=CONTENT_TYPE_LATEST)
    except TimeoutError:
        return Response(generate_latest(metrics.REGISTRY), media_type=CONTENT_TYPE_LATEST)
