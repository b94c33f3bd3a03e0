"""Every route of the service: REST, websockets, static files and pages, in the order in which they are tried."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from fastapi import APIRouter
from fastapi.openapi.docs import get_swagger_ui_html
from fastapi.responses import HTMLResponse
from fastapi.staticfiles import StaticFiles
from starlette.routing import BaseRoute

from app import headers, pages
from app.abort.endpoints import router as abort
from app.access import ANYONE, Role, allowed
from app.accounts.admin_endpoints import router as accounts
from app.accounts.endpoints import router as own_account
from app.annotations.endpoints import router as run_annotations
from app.approvals.endpoints import router as approvals
from app.auditing.endpoints import router as auditing
from app.compare.endpoints import router as compare
from app.control.endpoints import router as control
from app.diagnoses.endpoints import router as diagnoses
from app.health import router as health
from app.help.endpoints import router as glossary
from app.laboratory.endpoints import router as laboratory
from app.league.endpoints import router as league
from app.library.draft_endpoints import router as drafts
from app.library.endpoints import router as library
from app.live.endpoints import router as live
from app.live.watching import router as watching
from app.measured.batch_endpoints import router as batches
from app.measured.endpoints import router as measured
from app.measured.mapping_endpoints import router as mappings
from app.monitoring.endpoints import router as monitoring
from app.motions.endpoints import router as motions
from app.notifications.endpoints import router as notifications
from app.notifications.webhook_endpoints import router as webhooks
from app.pages.accounts import router as accounts_page
from app.pages.audit import router as audit_page
from app.pages.batches import router as batches_page
from app.pages.compare import router as compare_page
from app.pages.diagnoses import router as diagnoses_page
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
from app.retention.endpoints import router as retention
from app.rigs.endpoints import router as rigs
from app.runs.edit_endpoints import router as run_edits
from app.runs.endpoints import router as runs
from app.runs.table_endpoints import router as run_table
from app.runs.view_endpoints import router as run_views
from app.stability.endpoints import router as stability
from app.sweeps.analysis_endpoints import router as sweep_analysis
from app.sweeps.endpoints import router as sweeps
from app.table4.endpoints import router as table4

STATIC = Path(__file__).parent.parent / "frontend" / "static"
SWAGGER = "/static/vendor/swagger-ui"


@cache
def routes(upload_limit: int, measurements_limit: int) -> tuple[BaseRoute, ...]:
    """All routes, for bodies of at most so many bytes, and files of measurements of at most so many.

    They are shared by all applications with these limits in one process: the framework takes longer to analyse them than
    the rest of an application takes to start.
    """
    all_ = APIRouter()
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
        run_annotations,
        run_publishing,
        publishing,
    ):
        all_.include_router(router, max_body_size=upload_limit)
    for router in (batches, measured):
        all_.include_router(router, max_body_size=measurements_limit)
    all_.mount("/static", allowed(ANYONE)(StaticFiles(directory=STATIC)), name="static")
    all_.add_api_route("/api/docs", _docs, include_in_schema=False, response_class=HTMLResponse)
    for router in (
        accounts_page,
        stability_page,
        batches_page,
        recordings_page,
        plans_page,
        diagnoses_page,
        compare_page,
        lab_page,
        help_page,
        league_page,
        table4_page,
        sweeps_page,
        wall_page,
        audit_page,
        settings_page,
        pages.router,
    ):
        all_.include_router(router)
    return tuple(all_.routes)


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
