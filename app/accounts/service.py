"""Rules of accounts: names, roles, passwords and one-time links. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.access import Role
from app.accounts import keys, names, passwords
from app.accounts.repository import AccountRows
from app.models import Account, AccountLink
from app.models.accounts import key_of
from app.problems import Conflict, NotFound

LINK_HOLDS = timedelta(hours=24)
LINK_PATH = "/sign-in/link#"  # browsers send nothing behind #, so that no log holds the key
USED_UP = "The link is not valid: it was used, has expired or was replaced. Ask an administrator for a new one."


class AccountService:
    """Rules of accounts in one transaction."""

    def __init__(self, session: Session):
        self.rows = AccountRows(session)

    def any(self) -> bool:
        return self.rows.any()

    def listed(self) -> Sequence[Account]:
        return self.rows.listed()

    def get(self, account_id: str) -> Account:
        """The account with this id. Raises NotFound."""
        account = self.rows.get(account_id)
        if account is None:
            raise NotFound(f"There is no account {account_id}.")
        return account

    def named(self, name: str) -> Account:
        """The account with this name, in any case of its letters. Raises NotFound."""
        account = self.rows.keyed(key_of(name))
        if account is None:
            raise NotFound(f"There is no account {name}.")
        return account

    def add(self, name: str, role: Role, password: str | None = None) -> Account:
        """Add an account, which signs in once it has a password. Raises Conflict where the name is taken."""
        name = names.checked(name)
        if self.rows.keyed(key_of(name)):
            raise Conflict(f"The name {name} belongs to another account. Choose another name.")
        hashed = passwords.hashed(password) if password is not None else None
        account = Account(
            id=str(uuid.uuid4()),
            name=name,
            key=key_of(name),
            role=role.name.lower(),
            password=hashed,
            created_at=datetime.now(UTC),
        )
        try:
            self.rows.add(account)
        except IntegrityError:
            raise Conflict(f"The name {name} belongs to another account. Choose another name.") from None
        return account

    def give_role(self, account: Account, role: Role) -> None:
        """Change the role. Raises Conflict for the last administrator."""
        if role is not Role.ADMINISTRATOR:
            self._keep_one(account)
        account.role = role.name.lower()

    def disable(self, account: Account) -> None:
        """End all sessions, API tokens and links of an account for good, and refuse its sign-in.

        Raises Conflict for the last administrator.
        """
        self._keep_one(account)
        account.disabled_at = account.disabled_at or datetime.now(UTC)
        self.rows.end_everything(account.id, datetime.now(UTC))

    def enable(self, account: Account) -> None:
        """Let the owner of a disabled account sign in again, by the password. What was open before stays ended."""
        if account.disabled_at is not None:
            self.rows.end_everything(account.id, datetime.now(UTC))  # also what began at the moment of the disabling
        account.disabled_at = None

    def give_password(self, account: Account, password: str) -> None:
        """Store a new password. Links that were made before are no longer valid."""
        account.password = passwords.hashed(password)
        self.rows.forget_links(account.id, datetime.now(UTC))

    def link(self, account: Account | None = None) -> tuple[str, datetime]:
        """A new one-time link of an account, or for the first administrator: its path, and until when it is valid.

        It replaces earlier links. Raises Conflict where there is an account already, or the account is disabled.
        """
        if account is None and self.any():
            raise Conflict("There are accounts already. `rths account password-link NAME` makes a link for one of them.")
        if account is not None and account.disabled_at:
            raise Conflict(f"The account {account.name} is disabled. Enable it first.")
        now = datetime.now(UTC)
        if account is not None:
            self.rows.lock(account)
        self.rows.forget_links(account.id if account else None, now)
        key = keys.new_key()
        made = AccountLink(key_sha256=keys.sha256(key), account_id=account.id if account else None, expires_at=now + LINK_HOLDS)
        self.rows.add(made)
        return f"{LINK_PATH}{key}", made.expires_at

    def linked(self, key: str) -> AccountLink:
        """The link with this key. Raises NotFound where it is not valid."""
        link = self.rows.link(keys.sha256(key))
        disabled = link is not None and link.account is not None and link.account.disabled_at is not None
        if link is None or disabled or link.expires_at <= datetime.now(UTC) or (link.account_id is None and self.any()):
            raise NotFound(USED_UP)
        return link

    def use_link(self, key: str, password: str, name: str) -> Account:
        """Choose a password by a link, which is then used up. Returns the account; the first administrator is made by it."""
        link = self.linked(key)
        account = link.account
        if account is None:
            account = self.add(name, Role.ADMINISTRATOR, password)
            self.rows.remove(link)
        else:
            self.give_password(account, password)
        return account

    def _keep_one(self, account: Account) -> None:
        able = self.rows.administrators()
        if [one.id for one in able] == [account.id]:
            raise Conflict(f"{account.name} is the last administrator. Give another account the role administrator first.")
