"""Errors as problem+json (RFC 9457): title, detail and, for each error, where, problem, value and fix."""

from __future__ import annotations

import json
import logging
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from sqlalchemy.exc import InterfaceError, OperationalError
from sqlalchemy.exc import TimeoutError as PoolTimeout
from starlette.datastructures import FormData
from starlette.exceptions import HTTPException
from starlette.routing import compile_path

from app import headers
from app.config import is_form
from app.full import FIX, DiskFull, is_full
from app.raced import KINDS, is_raced
from rths_engine.foundation import location
from rths_engine.foundation.errors import Issue, RecordingError, RthsError, cut, limited

log = logging.getLogger(__name__)
MEDIA_TYPE = "application/problem+json"
TITLES = {
    400: "Bad request",
    401: "Unauthorized",
    403: "Forbidden",
    404: "Not found",
    405: "Method not allowed",
    409: "Conflict",
    408: "Request timeout",
    413: "Payload too large",
    415: "Unsupported media type",
    421: "Misdirected request",
    422: "Unprocessable content",
    429: "Too many requests",
    500: "Internal server error",
    503: "Service unavailable",
    507: "Insufficient storage",
}  # HTTP's own phrases: the type of a problem is about:blank
LONGEST_DETAIL = 4000  # characters; `errors` lists what is cut


class NotFound(Exception):
    """A request names something that does not exist."""


class Conflict(Exception):
    """A request does not fit the present state of what it names."""


class Forbidden(Exception):
    """The person behind a request may not do what the request asks for."""


class Unavailable(Exception):
    """The service cannot answer a request in time; the same request may succeed later."""


def problem(status: int, detail: str, errors: list[dict[str, Any]] | None = None) -> Response:
    """A response in problem+json (RFC 9457)."""
    title = TITLES.get(status, "Error")
    body = {
        "type": "about:blank",
        "title": title,
        "status": status,
        "detail": cut(detail, LONGEST_DETAIL),
        "errors": errors or [],
    }
    written = json.dumps(body, ensure_ascii=False).encode("utf-8", "backslashreplace")  # half a surrogate pair as \\udXXX
    return Response(written, status, dict(headers.EVERY), MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Answer every error of the application with a problem."""
    app.add_exception_handler(RthsError, _input_error)
    app.add_exception_handler(RecordingError, lambda _, error: problem(409, f"{error}."))
    app.add_exception_handler(RequestValidationError, _request_error)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(NotFound, lambda _, error: problem(404, str(error)))
    app.add_exception_handler(Conflict, lambda _, error: problem(409, str(error)))
    app.add_exception_handler(Forbidden, lambda _, error: problem(403, str(error)))
    app.add_exception_handler(Unavailable, _unavailable)
    app.add_exception_handler(DiskFull, lambda _, error: storage_full(str(error)))
    app.add_exception_handler(OSError, _disk_error)
    for error in (OperationalError, InterfaceError, PoolTimeout):
        app.add_exception_handler(error, _database_error)
    for kind in KINDS:
        app.add_exception_handler(kind, _raced)


def storage_full(detail: str) -> Response:
    """The response 507 to a request for which the disk has no room."""
    return problem(507, detail)


def _disk_error(_: Request, error: Exception) -> Response:
    if not is_full(error):
        raise error
    log.error("the disk is full: %s", error)
    return storage_full(f"The disk of the service is full. Nothing was stored; what is stored stays readable. {FIX}.")


def too_slow(why: str) -> Response:
    """The response 408 to a request whose body comes too slowly. The connection is closed after it."""
    answer = problem(408, f"{why}. Send the request again, over a faster connection.")
    answer.headers["Connection"] = "close"
    return answer


def too_large(limit: int) -> Response:
    """The response 413 to a request larger than `limit` bytes."""
    fix = "Send less (a plan can name an uploaded record), or raise the limit in the settings of the service."
    return problem(413, f"The request is larger than the limit of {limit / 1e6:g} MB. {fix}")


def _input_error(_: Request, error: Exception) -> Response:
    assert isinstance(error, RthsError)
    return problem(422, str(error), [issue.as_dict() for issue in error.issues])


def _request_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    expected = _expected_kind(request, error.body)
    if expected:
        given = request.headers.get("content-type") or "missing"
        return problem(415, f"The Content-Type of the body is {given}. Send {expected}.")
    details = error.errors()
    issues = list(limited((_issue(detail, request) for detail in details), len(details)))
    unread = any(detail["type"] == "json_invalid" for detail in details)
    return problem(400 if unread else 422, "; ".join(str(issue) for issue in issues), [issue.as_dict() for issue in issues])


def _issue(detail: Any, request: Request) -> Issue:
    where = location.dotted(detail["loc"][1:], _kind_of_body(request) if detail["loc"][0] == "body" else Any)
    if detail["type"] == "json_invalid":
        return Issue("", f"the body is not valid JSON: {detail['ctx']['error']} at character {detail['loc'][-1]}")
    given = detail["input"]
    value = None if detail["type"] == "missing" or isinstance(given, dict | list) else given
    if detail["type"] == "extra_forbidden":
        return Issue(where, "is not a field of this request", value, "correct its name, or leave it out")
    if detail["type"] == "string_too_short" and not str(given).strip():
        return Issue(where, "is blank", value, "give text with at least one character that is not a space")
    message = str(detail["msg"]).removeprefix("Value error, ")
    return Issue(where, message[:1].lower() + message[1:], value)


def _kind_of_body(request: Request) -> Any:
    """The declared type of the JSON body of the route."""
    field = getattr(request.scope.get("route"), "body_field", None)
    return field.field_info.annotation if field else Any


def _expected_kind(request: Request, body: Any) -> str | None:
    """The content type to send, or None where the body has the right type.

    With a wrong type the framework passes the body on unparsed, or as an empty form.
    """
    if isinstance(body, bytes) and body:
        return "application/json"
    form = is_form(request.headers.get("content-type", ""))
    return "multipart/form-data" if isinstance(body, FormData) and not form else None


def _http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    if error.status_code == 413:
        kind = request.headers.get("content-type", "")
        return too_large(request.app.state.settings.body_limit(request.url.path, kind))
    if is_full(error):  # a body that the disk for temporary files could not hold
        return _disk_error(request, error)
    if error.status_code == 405:
        return _method_not_allowed(request)
    response = problem(error.status_code, _detail(request, error))
    response.headers.update(error.headers or {})
    return response


def _method_not_allowed(request: Request) -> Response:
    """The response 405, with the methods that the address is described with; the framework lists those of one route."""
    path, described = request.url.path, request.app.openapi()["paths"]
    found = [path] if path in described else [route for route in described if compile_path(route)[0].match(path)]
    methods = {method.upper() for route in found for method in described[route]}
    allowed = ", ".join(sorted(methods | ({"HEAD"} if "GET" in methods else set()))) or "GET, HEAD"
    response = problem(405, f"{path} does not accept {request.method}. Methods allowed: {allowed}.")
    response.headers["Allow"] = allowed
    return response


def _detail(request: Request, error: HTTPException) -> str:
    """The detail of an HTTP error; a sentence where the framework gives its standard phrase only."""
    words = {
        "Not Found": f"There is nothing at {request.url.path}.",
        "There was an error parsing the body": (
            "The body cannot be read: it is not UTF-8, is nested too deeply, is an incomplete form, "
            "or has a number with too many digits."
        ),
    }
    return words.get(error.detail, error.detail)


def _database_error(request: Request, error: Exception) -> Response:
    if is_full(error):
        return _disk_error(request, error)
    log.error("%s %s: the database did not answer: %s", request.method, request.url.path, error)
    response = problem(503, "The database did not answer; nothing was stored. Try again in a moment.")
    response.headers["Retry-After"] = "5"
    return response


def _raced(request: Request, error: Exception) -> Response:
    """The response 409 where another request changed the same rows at the same moment. The log keeps where it happened."""
    if not is_raced(error):
        raise error
    log.warning(
        "%s %s: another request changed the same rows at the same moment", request.method, request.url.path, exc_info=error
    )
    return problem(
        409,
        "What this request names was added, changed or deleted by somebody else at the same moment; nothing was stored. "
        "Load it again, and repeat the request if it is still needed.",
    )


def _unavailable(_: Request, error: Exception) -> Response:
    response = problem(503, str(error))
    response.headers["Retry-After"] = "5"
    return response


def unexpected(request_id: str) -> Response:
    """The response to a request that failed by a fault of the program."""
    return problem(
        500, f"The service failed with an internal error; nothing was stored. Its log has it as request {request_id}."
    )
