"""Errors as problem+json (RFC 9457): title, detail and, for each thing wrong, where, problem, value and fix."""

from __future__ import annotations

import logging
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from app.states import IllegalTransition
from rths_engine.errors import Issue, RthsError

log = logging.getLogger(__name__)
MEDIA_TYPE = "application/problem+json"
TITLES = {
    400: "The request can't be read",
    403: "Not allowed from there",
    404: "Not found",
    405: "Not possible here",
    409: "Not possible in this state",
    413: "Too large",
    415: "Of a kind that is not read",
    422: "The input has mistakes",
    500: "The service failed",
}


class NotFound(Exception):
    """Something named in a request that does not exist."""


class Conflict(Exception):
    """Something that can't be done as things are."""


def problem(status: int, detail: str, errors: list[dict[str, Any]] | None = None) -> JSONResponse:
    title = TITLES.get(status, "Not possible")
    body = {"type": "about:blank", "title": title, "status": status, "detail": detail, "errors": errors or []}
    return JSONResponse(body, status, media_type=MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Every error of the application leaves as a problem."""
    app.add_exception_handler(RthsError, _input_error)
    app.add_exception_handler(RequestValidationError, _request_error)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(NotFound, lambda _, error: problem(404, str(error)))
    app.add_exception_handler(Conflict, lambda _, error: problem(409, str(error)))
    app.add_exception_handler(IllegalTransition, lambda _, error: problem(409, f"Not done: {error}."))
    app.add_exception_handler(Exception, _unexpected)


def _input_error(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RthsError)
    return problem(422, str(error), [issue.as_dict() for issue in error.issues])


def _request_error(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    issues = [Issue(".".join(str(step) for step in detail["loc"][1:]), detail["msg"]) for detail in error.errors()]
    unread = any(detail["type"] == "json_invalid" for detail in error.errors())
    return problem(400 if unread else 422, "; ".join(str(issue) for issue in issues), [issue.as_dict() for issue in issues])


def too_large(limit: int) -> JSONResponse:
    return problem(413, f"The request is larger than {limit / 1e6:g} MB, the most that is taken.")


def _http_error(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    if error.status_code == 413:
        return too_large(request.app.state.settings.upload_limit)
    response = problem(error.status_code, str(error.detail))
    response.headers.update(error.headers or {})
    return response


def _unexpected(request: Request, error: Exception) -> JSONResponse:
    log.exception("%s %s failed", request.method, request.url.path, exc_info=error)
    return problem(500, "The service met an error of its own; nothing was stored. Its log holds the details.")
