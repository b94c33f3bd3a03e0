"""Who may use an address: the declaration of every endpoint, websocket and mount, and the person behind a request."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum, IntEnum, StrEnum
from typing import Annotated, Any, Literal, TypeVar

from fastapi import Depends
from starlette.requests import HTTPConnection

DECLARED = "__access__"
PERSON = "rths.person"  # key of an ASGI scope: the SignedIn that the gate has let through

Declared = TypeVar("Declared", bound=Callable[..., Any])


class Role(IntEnum):
    """What an account may do. Each role may do all that a lower role may.

    A viewer reads everything, aborts tests and changes the own account. An operator submits tests of the library and drives
    the queue. An engineer also writes plans, submits sweeps, imports recordings and asks for diagnoses. An administrator also
    manages accounts, rigs, the laboratory and webhooks.
    """

    VIEWER = 1
    OPERATOR = 2
    ENGINEER = 3
    ADMINISTRATOR = 4


class Open(Enum):
    """Addresses without a role: `ANYONE` needs no sign-in, `WORKER` the token of workers."""

    ANYONE = "anyone"
    WORKER = "worker"


ANYONE, WORKER = Open.ANYONE, Open.WORKER


class Scope(StrEnum):
    """What an API token may do. Scopes do not include each other, and never exceed the role of the account."""

    READ = "read"
    OPERATE = "operate"
    SUBMIT = "submit"
    ADMINISTER = "administer"


SCOPE_OF = {
    Role.VIEWER: Scope.READ,
    Role.OPERATOR: Scope.OPERATE,
    Role.ENGINEER: Scope.SUBMIT,
    Role.ADMINISTRATOR: Scope.ADMINISTER,
}
ROLE_OF = {scope: role for role, scope in SCOPE_OF.items()}


@dataclass(frozen=True, slots=True)
class Access:
    """The declaration of an address: a role or `Open`, and the scope that an API token needs."""

    who: Role | Open
    scope: Scope | None


def allowed(who: Role | Open, scope: Scope | None = None) -> Callable[[Declared], Declared]:
    """Declare who may use an endpoint, a websocket or a mounted application; `scope` is by default the scope of the role."""

    def declare(endpoint: Declared) -> Declared:
        setattr(endpoint, DECLARED, Access(who, scope or (SCOPE_OF[who] if isinstance(who, Role) else None)))
        return endpoint

    return declare


def declared(endpoint: Any) -> Access | None:
    """The declaration of an endpoint or of a mounted application; None where it has none."""
    found: Access | None = getattr(endpoint, DECLARED, None)
    return found


@dataclass(frozen=True, slots=True)
class SignedIn:
    """The person behind a request: name and role of the account, and how the person signed in.

    `how` is local (without an account, on this computer), session (in a browser) or token (a program).
    """

    name: str
    role: Role
    how: Literal["local", "session", "token"]

    def named(self, typed: str) -> str:
        """The name to store with what this person does: of the account, or as typed where there are no accounts."""
        return typed if self.how == "local" else self.name


LOCAL = SignedIn("local administrator", Role.ADMINISTRATOR, "local")


def person(connection: HTTPConnection) -> SignedIn:
    """The person behind a request. Only addresses that need a role have one."""
    found: SignedIn = connection.scope[PERSON]
    return found


Who = Annotated[SignedIn, Depends(person)]
