"""JSON forms of accounts, sessions, API tokens and links."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from app.access import Scope
from app.text import Integer, Named, Storable

RoleName = Literal["viewer", "operator", "engineer", "administrator"]
Password = Annotated[Storable, StringConstraints(max_length=1000)]
Key = Annotated[Storable, StringConstraints(max_length=200)]
MOST_DAYS = 366


class _In(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _Out(BaseModel):
    model_config = ConfigDict(from_attributes=True)


class SignIn(_In):
    """Name and password of an account."""

    name: Storable = Field(max_length=80)
    password: Password


class LinkIn(_In):
    """The key of a one-time link: the part of its address behind #."""

    key: Key


class LinkUse(LinkIn):
    """The new password and, of the first administrator, the name."""

    password: Password
    name: Storable = Field("", max_length=80)


class LinkOut(BaseModel):
    """What a one-time link is for."""

    makes: Literal["first administrator", "password"]
    name: str = Field(description="name of the account; empty for the first administrator")
    replaces: bool = Field(description="whether the account has a password already, which the new one replaces")


class NewPassword(_In):
    """The present and the new password."""

    present: Password
    password: Password


class AccountOut(_Out):
    """An account. Without a password it waits for the one-time link to be used."""

    id: str
    name: str
    role: RoleName
    has_password: bool
    created_at: datetime
    disabled_at: datetime | None


class AccountList(BaseModel):
    """All accounts, the disabled ones last."""

    accounts: list[AccountOut]


class Me(BaseModel):
    """The person behind the request."""

    name: str
    role: RoleName
    how: Literal["local", "session", "token"] = Field(description="local: without an account, on this computer")
    scopes: list[Scope] | None = Field(description="scopes of the API token; null where the person signed in otherwise")


class NewAccount(_In):
    """A new account."""

    name: Annotated[Named, Field(max_length=80)]
    role: RoleName = "viewer"


class AccountChange(_In):
    """What of an account changes; null leaves it as it is."""

    role: RoleName | None = None
    disabled: bool | None = None


class LinkMade(BaseModel):
    """A one-time link to choose a password. It is shown only now."""

    account: AccountOut
    path: str = Field(description="path of the link on this control room")
    expires_at: datetime


class SessionOut(_Out):
    """A sign-in in a browser."""

    id: str
    started_at: datetime
    seen_at: datetime
    expires_at: datetime
    address: str
    browser: str
    present: bool = Field(False, description="whether this request belongs to it")


class SessionList(BaseModel):
    """The sessions of an account, the last seen first."""

    sessions: list[SessionOut]


class NewToken(_In):
    """A new API token: what it is for, its scopes, and how long it holds."""

    name: Annotated[Named, Field(max_length=80)]
    scopes: list[Scope] = Field([Scope.READ], min_length=1, max_length=4)
    days: Integer = Field(90, ge=1, le=MOST_DAYS)


class TokenOut(_Out):
    """An API token without its key."""

    id: str
    name: str
    scopes: list[Scope]
    created_at: datetime
    expires_at: datetime
    used_at: datetime | None


class TokenMade(TokenOut):
    """A new API token with its key, which is shown only now."""

    token: str


class TokenList(BaseModel):
    """The API tokens of an account, the newest first."""

    tokens: list[TokenOut]
