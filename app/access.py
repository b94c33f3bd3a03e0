"""Who may use an address: the declaration of every endpoint, websocket and mount, and the person behind a request."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from typing import Annotated, Any, Literal, TypeVar

from fastapi import Depends
from starlette.requests import HTTPConnection

from app.roles import ROLE_OF, SCOPE_OF, Role, Scope

__all__ = [
    "ACTING",
    "ANYONE",
    "ENDED",
    "LEADS",
    "LOCAL",
    "PERSON",
    "ROLE_OF",
    "SCOPE_OF",
    "WORKER",
    "Access",
    "Open",
    "Role",
    "Scope",
    "SignedIn",
    "Who",
    "allowed",
    "declared",
    "person",
    "stored_name",
]

DECLARED = "__access__"
ENDED = "rths.ended"  # key of an ASGI scope: the credential ended while the websocket was open
LEADS = "rths.leads"  # key of an ASGI scope: whether the address leads to a route
PERSON = "rths.person"  # key of an ASGI scope: the SignedIn that the gate has let through

Declared = TypeVar("Declared", bound=Callable[..., Any])


class Open(Enum):
    """Addresses without a role: `ANYONE` needs no sign-in, `WORKER` the token of workers."""

    ANYONE = "anyone"
    WORKER = "worker"


ANYONE, WORKER = Open.ANYONE, Open.WORKER


@dataclass(frozen=True, slots=True)
class Access:
    """The declaration of an address: a role or `Open`, and the scopes of which an API token needs one.

    `remembered` lets in who was verified in the last hours, while the database does not answer.
    """

    who: Role | Open
    scopes: frozenset[Scope]
    remembered: bool = False


def allowed(who: Role | Open, *scopes: Scope, tokens: bool = True, remembered: bool = False) -> Callable[[Declared], Declared]:
    """Declare who may use an endpoint, a websocket or a mounted application.

    `scopes` is by default the scope of the role; without `tokens` a person must sign in in a browser.
    """
    needed = frozenset(scopes) or frozenset({SCOPE_OF[who]} if isinstance(who, Role) else ())

    def declare(endpoint: Declared) -> Declared:
        setattr(endpoint, DECLARED, Access(who, needed if tokens else frozenset(), remembered))
        return endpoint

    return declare


def declared(endpoint: Any) -> Access | None:
    """The declaration of an endpoint or of a mounted application; None where it has none."""
    found: Access | None = getattr(endpoint, DECLARED, None)
    return found


@dataclass(frozen=True, slots=True)
class SignedIn:
    """The person behind a request: name and role of the account, and how the person signed in.

    `how` is local (without an account, on this computer), session (in a browser) or token (a program); `credential_id` names
    the session or the token, `until` when it expires, and only a token has `scopes`.
    """

    name: str
    role: Role
    how: Literal["local", "session", "token"]
    account_id: str = ""
    credential_id: str = ""
    scopes: frozenset[Scope] | None = None
    until: datetime | None = None

    def may(self, access: Access) -> bool:
        """Whether the scopes of an API token allow an address. Other people have no scopes."""
        return self.scopes is None or bool(self.scopes & access.scopes)

    @property
    def queues_any_plan(self) -> bool:
        """Whether the person may queue any plan, and not only plans of the library as they are."""
        return self.role >= Role.ENGINEER and (self.scopes is None or Scope.SUBMIT in self.scopes)

    def named(self, typed: str) -> str:
        """The name to store with what this person does: of the account, or as typed where there are no accounts."""
        return typed if self.how == "local" else self.name


ACTING: ContextVar[SignedIn | None] = ContextVar("acting", default=None)
"""The person behind the request that is being answered, set by the gate."""

LOCAL = SignedIn("local administrator", Role.ADMINISTRATOR, "local")


def stored_name(typed: str) -> str:
    """The name to store for the person behind the present request; the typed name outside of requests."""
    acting = ACTING.get()
    return acting.named(typed) if acting else typed


def person(connection: HTTPConnection) -> SignedIn:
    """The person behind a request. Only addresses that need a role have one."""
    found: SignedIn = connection.scope[PERSON]
    return found


Who = Annotated[SignedIn, Depends(person)]
