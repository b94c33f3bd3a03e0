"""Credentials that were verified lately, in memory: Abort and live views need no database.

A credential that has ended is forgotten at once in this process, and within RENEW_S in the other ones; its open websockets
close at the same moment.
"""

from __future__ import annotations

import asyncio
import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import partial
from typing import Literal

from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session, sessionmaker

from app.access import Role, Scope, SignedIn
from app.accounts.keys import sha256
from app.accounts.repository import AccountRows
from app.db import unit_of_work
from app.models import AccountSession, ApiToken
from app.open_sockets import OVER, OpenSockets, Standing

log = logging.getLogger(__name__)
How = Literal["session", "token"]
TABLES: dict[How, type[AccountSession] | type[ApiToken]] = {"session": AccountSession, "token": ApiToken}
IDLE = timedelta(hours=12)  # after which a session ends that is not used; chosen, see docs/decisions/0065
FRESH_S = 30.0  # age up to which a verification holds for every request
REMEMBERED_S = 12 * 3600.0  # ... and for Abort and live views, while the database does not answer
RENEW_S = 15.0
MOST = 10_000
TOGETHER = 500  # keys of one query


@dataclass(slots=True)
class _Known:
    how: How
    person: SignedIn
    checked: float
    used: bool = False

    def holds(self, age_s: float) -> bool:
        """Whether the credential was verified within `age_s` and has not expired since."""
        until = self.person.until
        return time.monotonic() - self.checked < age_s and (until is None or datetime.now(UTC) < until)


class Credentials:
    """Finds the person behind a session or an API token: in memory, or else in the database by threads of its own."""

    def __init__(self, maker: sessionmaker[Session], sockets: OpenSockets):
        self._maker, self._sockets = maker, sockets
        self._known: OrderedDict[str, _Known] = OrderedDict()
        self._lock = threading.Lock()
        self._threads = ThreadPoolExecutor(2, thread_name_prefix="rths-credentials")
        self._closing = threading.Event()
        self._renewing = threading.Thread(target=self._keep, daemon=True, name="rths-credentials-renewal")

    def start(self) -> None:
        self._renewing.start()

    def close(self) -> None:
        self._closing.set()
        self._threads.shutdown()
        if self._renewing.ident:
            self._renewing.join(5)

    async def person(self, how: How, key: str, remembered: bool) -> SignedIn | None:
        """The person behind a key; None where it is unknown, has ended or its account is disabled.

        With `remembered` a verification of the last REMEMBERED_S is enough. Raises SQLAlchemyError where the database is asked
        in vain.
        """
        hidden = sha256(key)
        with self._lock:
            known = self._known.get(hidden)
            if known and known.how == how and known.holds(REMEMBERED_S if remembered else FRESH_S):
                known.used = True
                return known.person
        return await asyncio.get_running_loop().run_in_executor(self._threads, self._verified, how, hidden)

    def forget(self, account_id: str, credential_id: str | None = None) -> None:
        """Forget all credentials of an account, or one of them, and look again who of the account may stay connected."""
        with self._lock:
            for hidden, known in list(self._known.items()):
                person = known.person
                if person.account_id == account_id and credential_id in {None, person.credential_id}:
                    del self._known[hidden]
        with suppress(RuntimeError):  # the service stops
            self._threads.submit(self._quietly, partial(self.look_again, account_id))

    def look_again(self, account_id: str | None = None) -> None:
        """Verify the credentials of the open websockets, of one account or of all, and close those that have ended."""
        self._sockets.expire()
        for how, table in TABLES.items():
            ids, now = self._sockets.credentials(how, account_id), datetime.now(UTC)
            for first in range(0, len(ids), TOGETHER):
                some = ids[first : first + TOGETHER]
                with unit_of_work(self._maker) as session:
                    rows = {row.id: row for row in AccountRows(session).with_ids(table, some)}
                    found = {one: _standing(how, rows.get(one), now) for one in some}
                self._sockets.settle(how, found)

    def renew(self) -> None:
        """Verify everything in memory again, and store when sessions and tokens were used last."""
        with self._lock:
            listed = list(self._known.items())
        for how in TABLES:
            keys = [hidden for hidden, known in listed if known.how == how]
            used = {hidden for hidden, known in listed if known.used}
            for first in range(0, len(keys), TOGETHER):
                self._renew(how, keys[first : first + TOGETHER], used)

    def _verified(self, how: How, hidden: str) -> SignedIn | None:
        self._renew(how, [hidden], {hidden})
        with self._lock:
            known = self._known.get(hidden)
            return known.person if known else None

    def _renew(self, how: How, keys: list[str], used: set[str]) -> None:
        begun, now = time.monotonic(), datetime.now(UTC)
        with unit_of_work(self._maker) as session:
            found = {row.key_sha256: row for row in AccountRows(session).with_keys(TABLES[how], keys)}
            for hidden in used & found.keys():
                _touch(found[hidden], now)
            valid = {hidden: _Known(how, _signed_in(how, row), begun) for hidden, row in found.items() if _holds(row, now)}
        with self._lock:
            for hidden in keys:
                self._known.pop(hidden, None)
            self._known.update(valid)
            while len(self._known) > MOST:
                self._known.popitem(last=False)

    def _keep(self) -> None:
        while not self._closing.wait(RENEW_S):
            self._quietly(self.renew)
            self._quietly(self.look_again)

    def _quietly(self, verify: Callable[[], None]) -> None:
        try:
            verify()
        except SQLAlchemyError as error:
            log.warning("credentials are not verified again: %s", error)


def _touch(row: AccountSession | ApiToken, now: datetime) -> None:
    """Store that a session or a token is used, at most once in RENEW_S."""
    if isinstance(row, ApiToken):
        row.used_at = now
    elif _holds(row, now) and now - row.seen_at > timedelta(seconds=RENEW_S):
        row.seen_at = now


def _holds(row: AccountSession | ApiToken, now: datetime) -> bool:
    if row.account.disabled_at is not None or row.expires_at <= now:
        return False
    return isinstance(row, ApiToken) or (row.ended_at is None and now - row.seen_at < IDLE)


def _standing(how: How, row: AccountSession | ApiToken | None, now: datetime) -> Standing:
    """Whose a credential is, or why it is nobody's any longer."""
    if row is not None and _holds(row, now):
        return Standing(_signed_in(how, row))
    return Standing(None, "the account is disabled" if row is not None and row.account.disabled_at else OVER[how])


def _signed_in(how: How, row: AccountSession | ApiToken) -> SignedIn:
    """The person of a valid credential."""
    until = row.expires_at if isinstance(row, ApiToken) else min(row.expires_at, row.seen_at + IDLE)
    scopes = frozenset(Scope(scope) for scope in row.scopes) if isinstance(row, ApiToken) else None
    account = row.account
    return SignedIn(account.name, Role[account.role.upper()], how, account.id, row.id, scopes, until)
