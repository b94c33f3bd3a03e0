"""The web service."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from functools import partial

from fastapi import FastAPI
from starlette.routing import Route

from app import db, openapi, problems
from app.abort.desk import Desk
from app.access import Role, allowed
from app.accounts import refusals
from app.accounts.credentials import Credentials
from app.accounts.throttle import Throttle
from app.audit.log import SERVICE
from app.audit.recorder import Recorder, Waiting
from app.audit.requests import Recording
from app.bodies import Bodies
from app.calculations.calculations import Calculations
from app.config import Settings, from_environment
from app.dependencies import READERS, WRITERS
from app.disk_guard import DiskGuard
from app.gate import Gate
from app.guard import Guard
from app.head import Head
from app.jobs import queue as durable
from app.jobs.workers import Workers
from app.leases import Once, alone
from app.live.audience import Audience
from app.live.hub import Hub
from app.live.relay import Relay
from app.monitoring import statements
from app.monitoring.collected import Collected
from app.monitoring.endpoints import Monitor
from app.notifications.dispatcher import Dispatcher
from app.observing import Observed
from app.open_sockets import OpenSockets
from app.pages.error_pages import ErrorPages
from app.retention.daily import Daily
from app.routes import routes
from app.runs.editing import RunEditing
from app.store import answers
from app.store.opening import store_of
from app.worker.embedded import EmbeddedWorker
from app.worker.kinds import KINDS
from rths_engine import __version__


def create_app(settings: Settings | None = None) -> FastAPI:
    """The application. `settings` default to the environment's. At its start it migrates the database and starts the worker."""
    configured = (settings or from_environment()).prepared()
    app = FastAPI(
        title="RTHS control room",
        version=__version__,
        docs_url=None,
        redoc_url=None,
        lifespan=_lifespan,
    )
    app.state.settings = configured
    app.state.hub = Hub()
    app.state.calculations = Calculations()
    app.state.writing = asyncio.Semaphore(WRITERS)
    app.state.reading = asyncio.Semaphore(READERS)
    app.state.throttle = Throttle()
    app.state.sockets = OpenSockets()
    app.state.audience = Audience(lambda: app.state.sessions, configured)
    app.state.desk = Desk(configured.url)
    problems.install(app)
    refusals.install(app)
    openapi.install(app)
    answers.install(app)
    app.router.routes.extend(routes(configured.upload_limit, configured.measurements_limit))
    _declare_description(app)
    app.add_middleware(Bodies, settings=configured)
    app.add_middleware(DiskGuard, settings=configured)
    app.add_middleware(Gate, settings=configured)
    app.add_middleware(Recording)
    app.add_middleware(Head)
    app.add_middleware(Guard, settings=configured)
    app.add_middleware(Observed)
    app.add_middleware(ErrorPages)
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    settings: Settings = app.state.settings
    await asyncio.to_thread(_migrate, settings.url)
    engine = db.connect(settings.url)
    statements.watch(engine)
    app.state.sessions = db.sessions(engine)
    app.state.monitor = Monitor(Collected(settings, app.state.sessions, app.state.hub, KINDS))
    app.state.credentials = Credentials(app.state.sessions, app.state.sockets)
    app.state.credentials.start()
    app.state.relay = Relay(app.state.sessions, KINDS)
    app.state.queue = durable.DurableQueue(engine)
    await asyncio.to_thread(_purge, app)
    app.state.audit = Recorder(app.state.sessions)
    app.state.audit.start()
    app.state.audit.put(Waiting(SERVICE, "service.started", details={"version": __version__}))
    app.state.desk.start()
    dispatcher = Dispatcher(app.state.sessions)
    dispatcher.start()
    daily = Daily(app.state.sessions, store_of(settings))
    daily.start()
    worker = EmbeddedWorker(settings, partial(_worker_ended, app)) if settings.embedded_worker else None
    if worker:
        worker.start()
    try:
        yield
    finally:
        if worker:
            await asyncio.to_thread(worker.stop)
        await asyncio.to_thread(dispatcher.stop)
        await asyncio.to_thread(daily.stop)
        app.state.audit.put(Waiting(SERVICE, "service.stopped"))
        await asyncio.to_thread(app.state.audit.stop)
        app.state.monitor.close()
        await asyncio.to_thread(app.state.credentials.close)
        await asyncio.to_thread(app.state.desk.stop)
        app.state.queue.close()
        app.state.relay.close()
        engine.dispose()
        app.state.audience.close()


def _migrate(url: str) -> None:
    """Bring the database and its queue to the newest schema; other web processes that start meanwhile wait."""
    with alone(url):
        db.migrate(url)
        durable.migrate(url)


def _purge(app: FastAPI) -> None:
    """Remove old records of the queue, and the runs whose time to be restored is over; in one web process at a time."""
    once = Once(app.state.sessions)
    if once.held("purge"):
        app.state.queue.purge()
        with db.unit_of_work(app.state.sessions) as session:
            RunEditing(session).purge(store_of(app.state.settings))
        once.release("purge")


def _declare_description(app: FastAPI) -> None:
    """Declare who may read the OpenAPI description, whose route the framework adds."""
    for route in app.routes:
        if isinstance(route, Route) and route.path == app.openapi_url:
            allowed(Role.VIEWER)(route.endpoint)


def _worker_ended(app: FastAPI, worker: str) -> None:
    """Remove the heartbeat of the embedded worker at its end, so that the next one takes over at once."""
    with suppress(*db.DATABASE_SILENT), db.unit_of_work(app.state.sessions) as session:
        Workers(session).forget(worker)
