"""Errors of pages as pages: what happened and where to go on."""

from __future__ import annotations

import logging
from collections.abc import Callable, Coroutine
from typing import Any

from fastapi import Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, Response
from fastapi.routing import APIRoute
from starlette.convertors import Convertor, register_url_convertor

from app.pages.rendering import page
from app.problems import NotFound
from rths_engine.foundation.errors import RthsError

log = logging.getLogger(__name__)


class PagePath(Convertor[str]):
    """Any address but those of the service's other parts."""

    regex = r"(?!api/|api$|static/|healthz).*"

    def convert(self, value: str) -> str:
        return value

    def to_string(self, value: str) -> str:
        return value


register_url_convertor("page", PagePath())


class PageRoute(APIRoute):
    """A route whose errors are pages, where the application's handlers would answer with JSON."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        answer = super().get_route_handler()

        async def answered(request: Request) -> Response:
            try:
                return await answer(request)
            except NotFound as error:
                return error_page(request, 404, "Not found", str(error))
            except (RthsError, RequestValidationError) as error:
                return error_page(request, 422, "This address can't be read", str(error))
            except Exception:
                log.exception("the page %s failed", request.url.path)
                detail = "The service met an error of its own and wrote it to its log. Running tests are not touched by it."
                return error_page(request, 500, "The service failed", detail)

        return answered


def error_page(request: Request, status: int, title: str, detail: str) -> HTMLResponse:
    """A page that says what went wrong."""
    return page(request, "error.html", status, title=title, detail=detail)
