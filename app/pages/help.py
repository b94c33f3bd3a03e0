"""The help: the documents of the program, the search in them, and keyboard shortcuts."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import FileResponse, HTMLResponse, Response
from markupsafe import Markup

from app.access import Role, allowed
from app.help import documents
from app.help.search import search
from app.pages.errors import PageRoute
from app.pages.rendering import HEADERS, page
from rths_engine.results.glossary import glossary

INDEX = "docs/README.md"

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/help")
@allowed(Role.VIEWER)
def start(request: Request, q: Annotated[str, Query(max_length=200)] = "") -> HTMLResponse:
    """The start of the help, or what a search found."""
    body = None if q.strip() else Markup(documents.html(INDEX))
    return page(request, "help.html", q=q, found=search(q), body=body, terms=glossary(), title="Help")


@router.get("/help/{name:path}")
@allowed(Role.VIEWER)
def document(request: Request, name: str) -> Response:
    """One document, or a picture in it."""
    if not name.endswith(".md"):
        path, media_type = documents.picture(name)
        return FileResponse(path, media_type=media_type, headers=HEADERS)
    body = Markup(documents.html(name))
    return page(request, "help.html", q="", found=[], body=body, terms=[], title=documents.title(name))
