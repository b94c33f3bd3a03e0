"""Sessions in browsers and API tokens of accounts. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime, timedelta

from sqlalchemy.orm import Session

from app.access import ROLE_OF, Role, Scope
from app.accounts import keys, passwords
from app.accounts.repository import AccountRows
from app.accounts.throttle import Throttle
from app.models import Account, AccountSession, ApiToken
from app.models.accounts import key_of
from app.problems import Conflict, NotFound
from rths_engine.foundation.errors import Issue, RthsError

SESSION_HOLDS = timedelta(days=7)
KNOWN_FOR = timedelta(days=90)  # an address that an account has signed in from
MOST_TOKENS = 100  # of one account
REFUSED = "The name or the password is not correct."


class Refused(Exception):
    """A sign-in with a name or a password that is not correct."""


class SigningIn:
    """Sessions and API tokens in one transaction."""

    def __init__(self, session: Session):
        self.rows = AccountRows(session)

    def verified(self, name: str, password: str, address: str, throttle: Throttle) -> Account:
        """The account of a name and a password. Raises Refused, or TooManyAttempts after wrong passwords."""
        key = key_of(name)
        account = self.rows.keyed(key)
        known = account is not None and self.rows.used_before(account.id, address)
        with throttle.attempt(key, address, known) as attempt:
            matches = passwords.matches(password, account.password if account else None)
            attempt.correct = matches and account is not None and account.disabled_at is None
        if account is None or not attempt.correct:
            raise Refused(REFUSED)
        return account

    def start(self, account: Account, address: str, browser: str) -> tuple[str, AccountSession]:
        """A new session of an account: its key and its row."""
        now = datetime.now(UTC)
        self.rows.forget_sessions(now - KNOWN_FOR)
        key = keys.new_key()
        session = AccountSession(
            id=str(uuid.uuid4()),
            account_id=account.id,
            key_sha256=keys.sha256(key),
            started_at=now,
            seen_at=now,
            expires_at=now + SESSION_HOLDS,
            address=address[:64],
            browser=browser[:200],
        )
        self.rows.add(session)
        return key, session

    def sessions(self, account_id: str) -> Sequence[AccountSession]:
        return self.rows.sessions(account_id, datetime.now(UTC))

    def end(self, account_id: str, session_id: str) -> None:
        """End a session of an account. Raises NotFound."""
        found = [one for one in self.sessions(account_id) if one.id == session_id]
        if not found:
            raise NotFound(f"There is no session {session_id} of this account.")
        found[0].ended_at = datetime.now(UTC)

    def end_all(self, account_id: str, but: str = "") -> None:
        """End all sessions of an account, but not the one with the id `but`."""
        for session in self.sessions(account_id):
            if session.id != but:
                session.ended_at = datetime.now(UTC)

    def tokens(self, account_id: str) -> Sequence[ApiToken]:
        return self.rows.tokens(account_id)

    def add_token(self, account: Account, name: str, scopes: Iterable[Scope], days: int) -> tuple[str, ApiToken]:
        """A new API token: its key and its row. Raises RthsError for a scope beyond the role of the account."""
        wanted = sorted(set(scopes))
        beyond = [scope for scope in wanted if ROLE_OF[scope] > Role[account.role.upper()]]
        if beyond:
            problem = f"goes beyond the role {account.role}: it needs the role {ROLE_OF[beyond[0]].name.lower()}"
            library = beyond[0] is Scope.SUBMIT and Role[account.role.upper()] is Role.OPERATOR
            fix = "leave it out: the scope operate queues plans of the library" if library else "leave it out"
            raise RthsError(Issue("scopes", problem, beyond[0].value, fix))
        self.rows.lock(account)
        if len(self.tokens(account.id)) >= MOST_TOKENS:
            raise Conflict(f"{account.name} has {MOST_TOKENS} API tokens. Revoke one first.")
        now, key = datetime.now(UTC), keys.new_key(keys.PREFIX)
        token = ApiToken(
            id=str(uuid.uuid4()),
            account_id=account.id,
            name=name,
            key_sha256=keys.sha256(key),
            scopes=[scope.value for scope in wanted],
            created_at=now,
            expires_at=now + timedelta(days=days),
        )
        self.rows.add(token)
        return key, token

    def revoke(self, account_id: str, token_id: str) -> None:
        """Remove an API token of an account. Raises NotFound."""
        token = self.rows.locked_token(account_id, token_id)
        if token is None:
            raise NotFound(f"There is no API token {token_id} of this account.")
        self.rows.remove(token)
