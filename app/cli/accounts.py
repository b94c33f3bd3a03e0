"""`rths account` and `rths token`: accounts and API tokens in the database of a control room, running or not."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime

from sqlalchemy.orm import Session

from app import db
from app.access import Role, Scope
from app.accounts.service import AccountService
from app.accounts.signing_in import SigningIn
from app.cli.serve import address
from app.cli.settings import settings, stored
from app.problems import Conflict, NotFound
from rths_engine.foundation.errors import Issue, RthsError

SOON = "A running control room follows within 30 s."


@contextmanager
def _transaction(given: Namespace) -> Iterator[Session]:
    """One transaction on the accounts. What the rules refuse is an RthsError."""
    url = stored(given).url
    db.migrate(url)
    engine = db.connect(url)
    try:
        with db.unit_of_work(db.sessions(engine)) as session:
            yield session
    except (Conflict, NotFound) as error:
        raise RthsError(Issue("account", str(error).rstrip("."))) from None
    finally:
        engine.dispose()


def link(given: Namespace) -> None:
    """`rths account link`: the one-time link that makes the first administrator."""
    with _transaction(given) as session:
        _print_link(given, *AccountService(session).link())


def add(given: Namespace) -> None:
    """`rths account add`: a new account, and the link by which its owner chooses the password."""
    with _transaction(given) as session:
        accounts = AccountService(session)
        _print_link(given, *accounts.link(accounts.add(given.name, Role[given.role.upper()])))


def password_link(given: Namespace) -> None:
    """`rths account password-link`: a link by which the owner of an account chooses a new password."""
    with _transaction(given) as session:
        accounts = AccountService(session)
        _print_link(given, *accounts.link(accounts.named(given.name)))


def listed(given: Namespace) -> None:
    """`rths account list`: name, role and state of every account."""
    with _transaction(given) as session:
        rows = AccountService(session).listed()
        for one in rows:
            state = "disabled" if one.disabled_at else "" if one.password else "has no password yet"
            print(f"{one.name:<40} {one.role:<14} {state}".rstrip())
    if not rows:
        print("There is no account yet. `rths account link` prints the link that makes the first administrator.")


def role(given: Namespace) -> None:
    """`rths account role`: give an account another role."""
    with _transaction(given) as session:
        accounts = AccountService(session)
        accounts.give_role(accounts.named(given.name), Role[given.role.upper()])
    print(f"{given.name} is now {given.role}. {SOON}")


def disable(given: Namespace) -> None:
    """`rths account disable`: end the sessions and API tokens of an account, or enable it again."""
    with _transaction(given) as session:
        accounts = AccountService(session)
        (accounts.enable if given.undo else accounts.disable)(accounts.named(given.name))
    print(f"{given.name} is {'enabled' if given.undo else 'disabled'}. {SOON}")


def token_add(given: Namespace) -> None:
    """`rths token add`: a new API token of an account; its key is printed once."""
    with _transaction(given) as session:
        account = AccountService(session).named(given.account)
        scopes = [Scope(scope) for scope in given.scope or [Scope.READ]]
        key, token = SigningIn(session).add_token(account, given.name, scopes, given.days)
    print(f"{key}\nKeep it now: it is not shown again. It expires on {_day(token.expires_at)}.")


def token_list(given: Namespace) -> None:
    """`rths token list`: the API tokens of an account."""
    with _transaction(given) as session:
        tokens = SigningIn(session).tokens(AccountService(session).named(given.account).id)
    for one in tokens:
        used = f"last used {_day(one.used_at)}" if one.used_at else "never used"
        print(f"{one.id}  {one.name:<30} {', '.join(one.scopes):<32} expires {_day(one.expires_at)}, {used}")
    if not tokens:
        print(f"{given.account} has no API token. `rths token add` makes one.")


def token_revoke(given: Namespace) -> None:
    """`rths token revoke`: end an API token."""
    with _transaction(given) as session:
        SigningIn(session).revoke(AccountService(session).named(given.account).id, given.token)
    print(f"The API token is revoked. {SOON}")


def _print_link(given: Namespace, path: str, expires_at: datetime) -> None:
    base = given.url.rstrip("/") if given.url else address(settings(given)).rstrip("/")
    print(f"{base}{path}\nThe link works once, until {expires_at:%Y-%m-%d %H:%M} UTC. Whoever has it can choose the password.")


def _day(moment: datetime) -> str:
    return f"{moment:%Y-%m-%d}"
