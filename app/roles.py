"""Roles of accounts and scopes of API tokens."""

from __future__ import annotations

from enum import IntEnum, StrEnum


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
