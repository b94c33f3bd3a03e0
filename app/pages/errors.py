"""Errors of pages, shown as pages: what happened, and links to continue."""

from __future__ import annotations

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
    """A route that shows what is wrong with its address as a page. Every other error becomes a problem, for people a page."""

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

        return answered


def error_page(request: Request, status: int, title: str, detail: str, again: str = "") -> HTMLResponse:
    """A page that describes an error, with a link to try the address `again`."""
    return page(request, "error.html", status, title=title, detail=detail, again=again)


def _sentence(detail: Any) -> str:
    """One error of an address's query: parameter, value and problem."""
    message = str(detail["msg"]).removeprefix("Input ")
    return f"{detail['loc'][-1]} = {detail['input']}: {message}"
