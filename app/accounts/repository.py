"""Rows of accounts, sessions, API tokens and links."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.access import Role
from app.db import lock, locked
from app.models import Account, AccountLink, AccountSession, ApiToken

Keyed = type[AccountSession] | type[ApiToken]


class AccountRows:
    """SQL of accounts. It never commits."""

    def __init__(self, session: Session):
        self.session = session

    def get(self, account_id: str) -> Account | None:
        return self.session.get(Account, account_id)

    def keyed(self, key: str) -> Account | None:
        return self.session.scalar(sa.select(Account).where(Account.key == key))

    def listed(self) -> Sequence[Account]:
        return self.session.scalars(sa.select(Account).order_by(Account.disabled_at.is_not(None), Account.key)).all()

    def any(self) -> bool:
        return self.session.scalar(sa.select(Account.id).limit(1)) is not None

    def administrators(self) -> Sequence[Account]:
        """The administrators who can sign in, locked until the end of the transaction."""
        self._wait_for_writers()
        able = (Account.role == Role.ADMINISTRATOR.name.lower(), Account.disabled_at.is_(None), Account.password.is_not(None))
        return self.session.scalars(sa.select(Account).where(*able).with_for_update()).all()

    def add(self, row: Account | AccountSession | ApiToken | AccountLink) -> None:
        self.session.add(row)
        self.session.flush()

    def remove(self, row: ApiToken | AccountLink) -> None:
        self.session.delete(row)

    def link(self, key_sha256: str) -> AccountLink | None:
        self._wait_for_writers()
        return self.session.get(AccountLink, key_sha256, with_for_update=True)

    def _wait_for_writers(self) -> None:
        """Begin the transaction that writes: SQLite has no SELECT FOR UPDATE, and reads outside of it before a change."""
        lock(self.session, Account.name, sa.false())

    def lock(self, account: Account) -> None:
        """Lock an account until the end of the transaction, so that what it has is counted by one request at a time."""
        lock(self.session, Account.name, Account.id == account.id)

    def forget_links(self, account_id: str | None, now: datetime) -> None:
        """Remove the links of an account (None: of the first administrator) and all that have expired."""
        theirs = AccountLink.account_id == account_id if account_id else AccountLink.account_id.is_(None)
        self.session.execute(sa.delete(AccountLink).where(theirs | (AccountLink.expires_at <= now)))

    def sessions(self, account_id: str, now: datetime) -> Sequence[AccountSession]:
        """The sessions of an account that have not ended, the last seen first."""
        going = (AccountSession.ended_at.is_(None), AccountSession.expires_at > now)
        query = sa.select(AccountSession).where(AccountSession.account_id == account_id, *going)
        return self.session.scalars(query.order_by(AccountSession.seen_at.desc())).all()

    def end_everything(self, account_id: str, now: datetime) -> None:
        """End the sessions of an account, and remove its API tokens and links."""
        going = (AccountSession.account_id == account_id, AccountSession.ended_at.is_(None))
        self.session.execute(sa.update(AccountSession).where(*going).values(ended_at=now))
        self.session.execute(sa.delete(ApiToken).where(ApiToken.account_id == account_id))
        self.forget_links(account_id, now)

    def used_before(self, account_id: str, address: str) -> bool:
        """Whether an account has signed in from an address."""
        query = sa.select(AccountSession.id).where(AccountSession.account_id == account_id, AccountSession.address == address)
        return self.session.scalar(query.limit(1)) is not None

    def forget_sessions(self, before: datetime) -> None:
        """Remove the sessions that began before a moment and have expired."""
        self.session.execute(sa.delete(AccountSession).where(AccountSession.expires_at < before))

    def tokens(self, account_id: str) -> Sequence[ApiToken]:
        query = sa.select(ApiToken).where(ApiToken.account_id == account_id)
        return self.session.scalars(query.order_by(ApiToken.created_at.desc())).all()

    def locked_token(self, account_id: str, token_id: str) -> ApiToken | None:
        """An API token of an account, locked against other writers until the end of the transaction."""
        return locked(self.session, ApiToken, account_id=account_id, id=token_id)

    def with_keys(self, table: Keyed, keys: Sequence[str]) -> Iterable[AccountSession | ApiToken]:
        """The sessions or API tokens with these stored keys, their accounts included."""
        query: sa.Select[Any] = sa.select(table).where(table.key_sha256.in_(keys))
        yield from self.session.scalars(query)

    def with_ids(self, table: Keyed, ids: Sequence[str]) -> Iterable[AccountSession | ApiToken]:
        """The sessions or API tokens with these ids, their accounts included."""
        query: sa.Select[Any] = sa.select(table).where(table.id.in_(ids))
        yield from self.session.scalars(query)
