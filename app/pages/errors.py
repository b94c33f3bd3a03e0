"""Errors of pages, shown as pages: what happened, and links to continue."""

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
UNPROCESSABLE = "Unprocessable content: the address is not valid"


class PagePath(Convertor[str]):
    """Any address except those of the API, the static files and the health check."""

    regex = r"(?!api/|api$|static/|healthz|livez).*"

    def convert(self, value: str) -> str:
        return value

    def to_string(self, value: str) -> str:
        return value


register_url_convertor("page", PagePath())


class PageRoute(APIRoute):
    """A route that shows its errors as pages; the application's handlers answer with JSON."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        answer = super().get_route_handler()

        async def answered(request: Request) -> Response:
            try:
                return await answer(request)
            except NotFound as error:
                return error_page(request, 404, "Not found", str(error))
            except RthsError as error:
                return error_page(request, 422, UNPROCESSABLE, str(error))
            except RequestValidationError as error:
                return error_page(request, 422, UNPROCESSABLE, "; ".join(map(_sentence, error.errors())))
            except Exception:
                log.exception("the page %s failed", request.url.path)
                detail = "The service could not make this page and wrote the error to its log. Running tests are not affected."
                return error_page(request, 500, "Internal server error", detail)

        return answered


def error_page(request: Request, status: int, title: str, detail: str) -> HTMLResponse:
    """A page that describes an error."""
    return page(request, "error.html", status, title=title, detail=detail)


def _sentence(detail: Any) -> str:
    """One error of an address's query: parameter, value and problem."""
    message = str(detail["msg"]).removeprefix("Input ")
    return f"{detail['loc'][-1]} = {detail['input']}: {message}"
