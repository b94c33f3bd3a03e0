"""Tables of accounts: their sessions in browsers, API tokens and one-time links. Keys are stored as SHA-256 only."""

from __future__ import annotations

import unicodedata
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column, relationship

from app.db import Base, Tags


class Account(Base):
    """A person who may sign in. `key` is the name without regard to case, `password` an argon2 hash, None at first."""

    __tablename__ = "account"

    id: Mapped[str] = mapped_column(sa.String(36), primary_key=True)
    name: Mapped[str] = mapped_column(sa.String(80))
    key: Mapped[str] = mapped_column(sa.String(240), unique=True)
    role: Mapped[str] = mapped_column(sa.String(20))
    password: Mapped[str | None] = mapped_column(sa.String(200))
    created_at: Mapped[datetime]
    disabled_at: Mapped[datetime | None]


def tidy(name: str) -> str:
    """A name with one space between its words and none around them, and one form of each letter (NFKC)."""
    return " ".join(unicodedata.normalize("NFKC", name).split())


def key_of(name: str) -> str:
    """The key of a name: equal for names that differ only in case, in spaces or in forms of the same letter."""
    return tidy(name).casefold()[:240]


class AccountSession(Base):
    """A sign-in in a browser. It stays in the table for a while after its end, so that known addresses can be told apart."""

    __tablename__ = "account_session"

    id: Mapped[str] = mapped_column(sa.String(36), primary_key=True)
    account_id: Mapped[str] = mapped_column(sa.ForeignKey("account.id", ondelete="CASCADE"), index=True)
    key_sha256: Mapped[str] = mapped_column(sa.String(64), unique=True)
    started_at: Mapped[datetime]
    seen_at: Mapped[datetime]
    expires_at: Mapped[datetime]
    ended_at: Mapped[datetime | None]
    address: Mapped[str] = mapped_column(sa.String(64))
    browser: Mapped[str] = mapped_column(sa.String(200))
    account: Mapped[Account] = relationship(lazy="joined")


class ApiToken(Base):
    """A key of a program that acts for an account, within `scopes`."""

    __tablename__ = "api_token"

    id: Mapped[str] = mapped_column(sa.String(36), primary_key=True)
    account_id: Mapped[str] = mapped_column(sa.ForeignKey("account.id", ondelete="CASCADE"), index=True)
    name: Mapped[str] = mapped_column(sa.String(80))
    key_sha256: Mapped[str] = mapped_column(sa.String(64), unique=True)
    scopes: Mapped[list[str]] = mapped_column(Tags)
    created_at: Mapped[datetime]
    expires_at: Mapped[datetime]
    used_at: Mapped[datetime | None]
    account: Mapped[Account] = relationship(lazy="joined")


class AccountLink(Base):
    """A one-time link: to choose a password of an account or, without an account, to make the first administrator."""

    __tablename__ = "account_link"

    key_sha256: Mapped[str] = mapped_column(sa.String(64), primary_key=True)
    account_id: Mapped[str | None] = mapped_column(sa.ForeignKey("account.id", ondelete="CASCADE"))
    expires_at: Mapped[datetime]
    account: Mapped[Account | None] = relationship(lazy="joined")
