"""Answers to a sign-in that is refused: 401, and 429 while it must wait."""

from __future__ import annotations

from fastapi import FastAPI, Request
from fastapi.responses import Response

from app.accounts.signing_in import Refused
from app.accounts.throttle import TooManyAttempts
from app.problems import problem


def install(app: FastAPI) -> None:
    """Answer refused sign-ins with a problem."""
    app.add_exception_handler(Refused, lambda _, error: problem(401, str(error)))
    app.add_exception_handler(TooManyAttempts, _too_many)


def _too_many(_: Request, error: Exception) -> Response:
    assert isinstance(error, TooManyAttempts)
    answer = problem(429, str(error))
    answer.headers["Retry-After"] = str(error.retry_s)
    return answer
