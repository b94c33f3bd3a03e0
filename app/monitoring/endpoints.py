"""REST endpoints for monitoring. They use no thread and no connection of other requests."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import chain
from typing import TypeVar

from fastapi import APIRouter, Request, Response
from prometheus_client import CONTENT_TYPE_LATEST, generate_latest
from prometheus_client.registry import Collector

from app import metrics, openapi
from app.access import ANYONE, Role, allowed
from app.monitoring import checks
from app.monitoring.schemas import Readiness

router = APIRouter(tags=["health"])
WITHIN_S = 3.0
Found = TypeVar("Found")


class Monitor:
    """The threads of monitoring, and the collector of the application."""

    def __init__(self, collected: Collector):
        self.collected = collected
        self._threads = ThreadPoolExecutor(2, thread_name_prefix="rths-monitor")

    async def ask(self, look: Callable[[], Found]) -> Found:
        """Look in a thread of monitoring. Raises TimeoutError."""
        return await asyncio.wait_for(asyncio.get_running_loop().run_in_executor(self._threads, look), WITHIN_S)

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
    """Report whether the service can accept and execute tests, with a reason for each check: 200 when it is ready, else 503."""
    state = request.app.state
    try:
        found: Readiness = await state.monitor.ask(lambda: checks.readiness(state.settings, state.sessions))
    except TimeoutError:
        found = checks.silent(WITHIN_S)
    response.status_code = 200 if found.ready else 503
    return found


@router.get("/metrics", response_class=Response, responses=openapi.file("text/plain"))
@allowed(Role.VIEWER)
async def prometheus(request: Request) -> Response:
    """Report the metrics of this process, of the workers and of the database in the text form of Prometheus."""
    monitor: Monitor = request.app.state.monitor
    try:
        return Response(await monitor.ask(monitor.text), media_type=CONTENT_TYPE_LATEST)
    except TimeoutError:
        return Response(generate_latest(metrics.REGISTRY), media_type=CONTENT_TYPE_LATEST)
