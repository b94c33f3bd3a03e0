"""The services of accounts of a request, and what ends with its transaction: credentials in memory."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request
from fastapi.responses import Response

from app.access import PERSON, Role, SignedIn
from app.accounts.credentials import Credentials
from app.accounts.service import AccountService
from app.accounts.signing_in import SigningIn
from app.accounts.throttle import Throttle
from app.db import afterwards
from app.dependencies import OneSession
from app.gate import cookie_name
from app.models import Account


def account_service(session: OneSession) -> AccountService:
    """The service of accounts in the session of the request."""
    return AccountService(session)


def signing_in(session: OneSession) -> SigningIn:
    """Sessions and API tokens in the session of the request."""
    return SigningIn(session)


class Browser:
    """The browser or program of a request: its address, its cookie, and the credentials that this process remembers."""

    def __init__(self, request: Request, session: OneSession):
        self.request, self.session = request, session
        self.throttle: Throttle = request.app.state.throttle
        self.address = request.client.host if request.client else ""
        self.name = request.headers.get("user-agent", "")

    def signs_in(self, account: Account, signing: SigningIn, response: Response) -> None:
        """Start a session with a new key, whatever cookie the browser sent."""
        key, row = signing.start(account, self.address, self.name)
        role = Role[account.role.upper()]
        who = SignedIn(account.name, role, "session", account.id, row.id)
        self.request.scope[PERSON] = who  # the audit log names the account, whatever was typed
        settings = self.request.app.state.settings
        response.set_cookie(
            cookie_name(settings),
            key,
            max_age=int((row.expires_at - row.started_at).total_seconds()),
            httponly=True,
            samesite="lax",
            secure=self.request.url.scheme == "https",
        )

    def ends_session(self, who: SignedIn, signing: SigningIn, response: Response) -> None:
        """End the session of a person, in the database and in the browser."""
        if who.how == "session":
            signing.end(who.account_id, who.credential_id)
            self.forgets(who.account_id, who.credential_id)
        response.delete_cookie(cookie_name(self.request.app.state.settings), httponly=True, samesite="lax")

    def forgets(self, account_id: str, credential_id: str | None = None) -> None:
        """Let no request in any longer by a credential, once the change is stored."""
        credentials: Credentials = self.request.app.state.credentials
        afterwards(self.session, "after_commit", lambda: credentials.forget(account_id, credential_id))


Accounts = Annotated[AccountService, Depends(account_service)]
Signing = Annotated[SigningIn, Depends(signing_in)]
OneBrowser = Annotated[Browser, Depends()]
