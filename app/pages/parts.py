"""Parts of pages, which scripts put in place. A person who types the address of a part gets the whole page instead."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fastapi import Request
from fastapi.responses import RedirectResponse, Response

from app.pages.error_pages import for_a_person
from app.pages.rendering import page


def part(request: Request, template: str, whole: str, context: Callable[[], dict[str, Any]]) -> Response:
    """A part of the page at the address `whole`; its context is computed only where it is shown."""
    if for_a_person(request.headers):
        return RedirectResponse(whole, 303, {"Vary": "Accept"})
    return page(request, template, **context())
