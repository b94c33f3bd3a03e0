"""The web service."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from functools import partial
from pathlib import Path

from fastapi import FastAPI
from fastapi.openapi.docs import get_swagger_ui_html
from fastapi.responses import HTMLResponse
from fastapi.staticfiles import StaticFiles
from starlette.routing import Route

from app import db, headers, openapi, pages, problems
from app.abort.desk import Desk
from app.abort.endpoints import router as abort
from app.access import ANYONE, Role, allowed
from app.accounts import refusals
from app.accounts.admin_endpoints import router as accounts
from app.accounts.credentials import Credentials
from app.accounts.endpoints import router as own_account
from app.accounts.throttle import Throttle
from app.annotations.endpoints import router as run_annotations
from app.approvals.endpoints import router as approvals
from app.audit.log import SERVICE
from app.audit.recorder import Recorder, Waiting
from app.audit.requests import Recording
from app.auditing.endpoints import router as auditing
from app.bodies import Bodies
from app.calculations.calculations import Calculations
from app.compare.endpoints import router as compare
from app.config import Settings, from_environment
from app.control.endpoints import router as control
from app.dependencies import READERS, WRITERS
from app.diagnoses.endpoints import router as diagnoses
from app.disk_guard import DiskGuard
from app.gate import Gate
from app.guard import Guard
from app.head import Head
from app.health import router as health
from app.help.endpoints import router as glossary
from app.jobs import queue as durable
from app.jobs.workers import Workers
from app.laboratory.endpoints import router as laboratory
from app.league.endpoints import router as league
from app.leases import Once, alone
from app.library.draft_endpoints import router as drafts
from app.library.endpoints import router as library
from app.live.audience import Audience
from app.live.endpoints import router as live
from app.live.hub import Hub
from app.live.relay import Relay
from app.live.watching import router as watching
from app.measured.batch_endpoints import router as batches
from app.measured.endpoints import router as measured
from app.measured.mapping_endpoints import router as mappings
from app.monitoring import statements
from app.monitoring.collected import Collected
from app.monitoring.endpoints import Monitor
from app.monitoring.endpoints import router as monitoring
from app.motions.endpoints import router as motions
from app.notifications.dispatcher import Dispatcher
from app.notifications.endpoints import router as notifications
from app.notifications.webhook_endpoints import router as webhooks
from app.observing import Observed
from app.open_sockets import OpenSockets
from app.pages.accounts import router as accounts_page
from app.pages.audit import router as audit_page
from app.pages.batches import router as batches_page
from app.pages.compare import router as compare_page
from app.pages.diagnoses import router as diagnoses_page
from app.pages.error_pages import ErrorPages
from app.pages.help import router as help_page
from app.pages.lab import router as lab_page
from app.pages.league import router as league_page
from app.pages.plans import router as plans_page
from app.pages.recordings import router as recordings_page
from app.pages.settings import router as settings_page
from app.pages.stability import router as stability_page
from app.pages.sweeps import router as sweeps_page
from app.pages.table4 import router as table4_page
from app.pages.wall import router as wall_page
from app.plans.endpoints import router as plans
from app.preflight.endpoints import router as preflight
from app.publishing.endpoints import router as publishing
from app.publishing.run_endpoints import router as run_publishing
from app.queue.endpoints import router as queue
from app.retention.daily import Daily
from app.retention.endpoints import router as retention
from app.rigs.endpoints import router as rigs
from app.runs.edit_endpoints import router as run_edits
from app.runs.editing import RunEditing
from app.runs.endpoints import router as runs
from app.runs.table_endpoints import router as run_table
from app.runs.view_endpoints import router as run_views
from app.stability.endpoints import router as stability
from app.store import answers
from app.store.opening import store_of
from app.sweeps.analysis_endpoints import router as sweep_analysis
from app.sweeps.endpoints import router as sweeps
from app.table4.endpoints import router as table4
from app.worker.embedded import EmbeddedWorker
from app.worker.kinds import KINDS
from rths_engine import __version__

STATIC = Path(__file__).parent.parent / "frontend" / "static"
SWAGGER = "/static/vendor/swagger-ui"


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
    for router in (
        run_table,
        run_views,
        run_edits,
        runs,
        sweeps,
        sweep_analysis,
        queue,
        abort,
        rigs,
        control,
        approvals,
        retention,
        motions,
        plans,
        preflight,
        library,
        drafts,
        mappings,
        diagnoses,
        compare,
        stability,
        league,
        table4,
        laboratory,
        notifications,
        webhooks,
        auditing,
        health,
        monitoring,
        glossary,
        own_account,
        accounts,
        live,
        watching,
    ):
        app.include_router(router, max_body_size=configured.upload_limit)
    app.include_router(run_annotations, max_body_size=configured.upload_limit)
    app.include_router(run_publishing, max_body_size=configured.upload_limit)
    app.include_router(publishing, max_body_size=configured.upload_limit)
    app.include_router(batches, max_body_size=configured.measurements_limit)
    app.include_router(measured, max_body_size=configured.measurements_limit)
    app.mount("/static", allowed(ANYONE)(StaticFiles(directory=STATIC)), name="static")
    app.add_api_route("/api/docs", _docs, include_in_schema=False, response_class=HTMLResponse)
    app.include_router(accounts_page)
    app.include_router(stability_page)
    app.include_router(batches_page)
    app.include_router(recordings_page)
    app.include_router(plans_page)
    app.include_router(diagnoses_page)
    app.include_router(compare_page)
    app.include_router(lab_page)
    app.include_router(help_page)
    app.include_router(league_page)
    app.include_router(table4_page)
    app.include_router(sweeps_page)
    app.include_router(wall_page)
    app.include_router(audit_page)
    app.include_router(settings_page)
    app.include_router(pages.router)
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


@allowed(Role.VIEWER)
def _docs() -> HTMLResponse:
    page = get_swagger_ui_html(
        openapi_url="/openapi.json",
        title="RTHS control room: REST",
        swagger_js_url=f"{SWAGGER}/swagger-ui-bundle.js",
        swagger_css_url=f"{SWAGGER}/swagger-ui.css",
        swagger_favicon_url="/static/favicon.svg",
    )
    page.headers[headers.POLICY] = headers.of_api_docs(bytes(page.body).decode())
    return page
