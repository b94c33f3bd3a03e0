"""The answer to a request while the store does not answer."""

from __future__ import annotations

from fastapi import FastAPI, Request
from fastapi.responses import Response

from app.problems import problem
from app.store.base import StoreSilent

RETRY_AFTER_S = 5


def install(app: FastAPI) -> None:
    """Answer 503 where the store does not answer."""
    app.add_exception_handler(StoreSilent, _silent)


def _silent(_: Request, error: Exception) -> Response:
    said = str(error)
    response = problem(503, f"{said[:1].upper()}{said[1:]}. Try again in a moment.")
    response.headers["Retry-After"] = str(RETRY_AFTER_S)
    return response
