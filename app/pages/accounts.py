"""Pages of accounts: sign in, choose a password by a link, the own account, and signing out."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse, RedirectResponse

from app.access import ANYONE, SCOPE_OF, Role, Who, allowed
from app.accounts.dependency import Accounts, OneBrowser, Signing
from app.accounts.passwords import LONGEST, SHORTEST
from app.pages.errors import PageRoute
from app.pages.rendering import page

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/sign-in")
@allowed(ANYONE)
def sign_in(request: Request, accounts: Accounts, to: Annotated[str, Query(max_length=4000)] = "/") -> HTMLResponse:
    """The sign-in page. Its module leads to the page `to` of this control room afterwards."""
    return page(request, "sign_in.html", any_account=accounts.any())


@router.get("/sign-in/link")
@allowed(ANYONE)
def sign_in_link(request: Request) -> HTMLResponse:
    """The page of a one-time link, whose key stays in the browser."""
    return page(request, "sign_in_link.html", shortest=SHORTEST, longest=LONGEST)


@router.get("/account")
@allowed(Role.VIEWER, tokens=False)
def account(request: Request, who: Who) -> HTMLResponse:
    """The page of the own account."""
    scopes = [(scope.value, role) for role, scope in SCOPE_OF.items()]
    return page(request, "account.html", shortest=SHORTEST, longest=LONGEST, scopes=scopes)


@router.post("/sign-out")
@allowed(Role.VIEWER, tokens=False)
def sign_out(who: Who, signing: Signing, browser: OneBrowser) -> RedirectResponse:
    """End the session of this browser, and show the sign-in page."""
    answer = RedirectResponse("/sign-in", 303)
    browser.ends_session(who, signing, answer)
    return answer
