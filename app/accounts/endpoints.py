"""REST endpoints of signing in and of the own account."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import Response

from app.access import ANYONE, Role, Scope, SignedIn, Who, allowed
from app.accounts import passwords
from app.accounts.dependency import Accounts, OneBrowser, Signing
from app.accounts.schemas import (
    LinkIn,
    LinkOut,
    LinkUse,
    Me,
    NewPassword,
    NewToken,
    SessionList,
    SessionOut,
    SignIn,
    TokenList,
    TokenMade,
    TokenOut,
)
from app.openapi import told
from app.problems import Conflict
from rths_engine.foundation.errors import Issue, RthsError

router = APIRouter(prefix="/api/v1", tags=["accounts"])


@router.post("/sign-in", status_code=204, response_class=Response, responses=told(401, 429, 503))
@allowed(ANYONE)
def sign_in(asked: Annotated[SignIn, Body()], signing: Signing, browser: OneBrowser, response: Response) -> None:
    """Sign in in a browser: the answer sets the cookie of a new session. Programs send an API token instead."""
    account = signing.verified(asked.name, asked.password, browser.address, browser.throttle)
    browser.signs_in(account, signing, response)


@router.post("/sign-out", status_code=204, response_class=Response)
@allowed(Role.VIEWER, tokens=False)
def sign_out(who: Who, signing: Signing, browser: OneBrowser, response: Response) -> None:
    """End the session of this browser."""
    browser.ends_session(who, signing, response)


@router.post("/sign-in/link/read", responses=told(404))
@allowed(ANYONE)
def read_link(asked: Annotated[LinkIn, Body()], accounts: Accounts) -> LinkOut:
    """Tell what a one-time link is for. The link stays valid."""
    account = accounts.linked(asked.key).account
    if account is None:
        return LinkOut(makes="first administrator", name="", replaces=False)
    return LinkOut(makes="password", name=account.name, replaces=account.password is not None)


@router.post("/sign-in/link", status_code=204, response_class=Response, responses=told(404, 503))
@allowed(ANYONE)
def use_link(
    asked: Annotated[LinkUse, Body()], accounts: Accounts, signing: Signing, browser: OneBrowser, response: Response
) -> None:
    """Choose a password by a one-time link, and sign in. All earlier sessions of the account end."""
    account = accounts.use_link(asked.key, asked.password, asked.name)
    signing.end_all(account.id)
    browser.forgets(account.id)
    browser.signs_in(account, signing, response)


@router.get("/account")
@allowed(Role.VIEWER, *Scope)
def me(who: Who) -> Me:
    """The person behind the request, and what the person may do."""
    scopes = None if who.scopes is None else sorted(who.scopes)
    return Me.model_validate({"name": who.name, "role": who.role.name.lower(), "how": who.how, "scopes": scopes})


@router.post("/account/password", status_code=204, response_class=Response, responses=told(429, 503))
@allowed(Role.VIEWER, tokens=False)
def change_password(
    asked: Annotated[NewPassword, Body()], who: Who, accounts: Accounts, signing: Signing, browser: OneBrowser
) -> None:
    """Change the own password. All other sessions of the account end; API tokens stay."""
    account = accounts.get(_own(who))
    with browser.throttle.attempt(account.key, browser.address, known=True) as attempt:
        attempt.correct = passwords.matches(asked.present, account.password)
    if not attempt.correct:
        raise RthsError(Issue("present", "is not the present password"))
    accounts.give_password(account, asked.password)
    signing.end_all(account.id, but=who.credential_id)
    browser.forgets(account.id)


@router.get("/account/sessions", responses=told(409))
@allowed(Role.VIEWER, tokens=False)
def sessions(who: Who, signing: Signing) -> SessionList:
    """List the browsers in which the own account is signed in."""
    listed = [SessionOut.model_validate(one) for one in signing.sessions(_own(who))]
    return SessionList(sessions=[one.model_copy(update={"present": one.id == who.credential_id}) for one in listed])


@router.delete("/account/sessions", status_code=204, response_class=Response)
@allowed(Role.VIEWER, tokens=False)
def end_sessions(who: Who, signing: Signing, browser: OneBrowser) -> None:
    """Sign out everywhere else: end all other sessions of the own account."""
    signing.end_all(_own(who), but=who.credential_id)
    browser.forgets(who.account_id)


@router.delete("/account/sessions/{session_id}", status_code=204, response_class=Response)
@allowed(Role.VIEWER, tokens=False)
def end_session(session_id: str, who: Who, signing: Signing, browser: OneBrowser) -> None:
    """End a session of the own account."""
    signing.end(_own(who), session_id)
    browser.forgets(who.account_id, session_id)


@router.get("/account/tokens", responses=told(409))
@allowed(Role.VIEWER, tokens=False)
def tokens(who: Who, signing: Signing) -> TokenList:
    """List the API tokens of the own account. Keys are not shown."""
    return TokenList(tokens=[TokenOut.model_validate(one) for one in signing.tokens(_own(who))])


@router.post("/account/tokens", status_code=201)
@allowed(Role.VIEWER, tokens=False)
def add_token(asked: Annotated[NewToken, Body()], who: Who, accounts: Accounts, signing: Signing) -> TokenMade:
    """Make an API token for a program. Its key is shown only now; its scopes stay within the role of the account."""
    key, token = signing.add_token(accounts.get(_own(who)), asked.name, asked.scopes, asked.days)
    return TokenMade(**TokenOut.model_validate(token).model_dump(), token=key)


@router.delete("/account/tokens/{token_id}", status_code=204, response_class=Response)
@allowed(Role.VIEWER, tokens=False)
def revoke_token(token_id: str, who: Who, signing: Signing, browser: OneBrowser) -> None:
    """Revoke an API token of the own account."""
    signing.revoke(_own(who), token_id)
    browser.forgets(who.account_id, token_id)


def _own(who: SignedIn) -> str:
    """The id of the account of a person. Raises Conflict for who is signed in without an account."""
    if not who.account_id:
        raise Conflict("You are signed in without an account. Start the control room without --local to use accounts.")
    return who.account_id
