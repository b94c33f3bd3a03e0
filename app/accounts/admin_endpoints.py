"""REST endpoints of the accounts of others, for administrators."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import Response

from app.access import Role, allowed
from app.accounts.dependency import Accounts, OneBrowser, Signing
from app.accounts.schemas import (
    AccountChange,
    AccountList,
    AccountOut,
    LinkMade,
    NewAccount,
    TokenList,
    TokenOut,
)
from app.accounts.service import AccountService
from app.models import Account

router = APIRouter(prefix="/api/v1/accounts", tags=["accounts"])


@router.get("")
@allowed(Role.ADMINISTRATOR, tokens=False)
def listed(accounts: Accounts) -> AccountList:
    """List all accounts."""
    return AccountList(accounts=[_out(one) for one in accounts.listed()])


@router.post("", status_code=201)
@allowed(Role.ADMINISTRATOR, tokens=False)
def add(asked: Annotated[NewAccount, Body()], accounts: Accounts) -> LinkMade:
    """Add an account. The answer holds a one-time link by which its owner chooses the password."""
    return _link(accounts, accounts.add(asked.name, Role[asked.role.upper()]))


@router.patch("/{account_id}")
@allowed(Role.ADMINISTRATOR, tokens=False)
def change(account_id: str, asked: Annotated[AccountChange, Body()], accounts: Accounts, browser: OneBrowser) -> AccountOut:
    """Change the role of an account, or disable or enable it.

    Disabling ends all sessions, API tokens and links of the account at once and for good.
    """
    account = accounts.get(account_id)
    if asked.role is not None:
        accounts.give_role(account, Role[asked.role.upper()])
    if asked.disabled is not None:
        (accounts.disable if asked.disabled else accounts.enable)(account)
    browser.forgets(account_id)
    return _out(account)


@router.post("/{account_id}/password-link", status_code=201)
@allowed(Role.ADMINISTRATOR, tokens=False)
def password_link(account_id: str, accounts: Accounts) -> LinkMade:
    """Make a one-time link by which the owner of an account chooses a new password. It replaces earlier links."""
    return _link(accounts, accounts.get(account_id))


@router.get("/{account_id}/tokens")
@allowed(Role.ADMINISTRATOR, tokens=False)
def tokens(account_id: str, accounts: Accounts, signing: Signing) -> TokenList:
    """List the API tokens of an account. Keys are not shown."""
    return TokenList(tokens=[TokenOut.model_validate(one) for one in signing.tokens(accounts.get(account_id).id)])


@router.delete("/{account_id}/tokens/{token_id}", status_code=204, response_class=Response)
@allowed(Role.ADMINISTRATOR, tokens=False)
def revoke(account_id: str, token_id: str, signing: Signing, browser: OneBrowser) -> None:
    """Revoke an API token of an account."""
    signing.revoke(account_id, token_id)
    browser.forgets(account_id, token_id)


def _out(account: Account) -> AccountOut:
    return AccountOut.model_validate(
        {
            "id": account.id,
            "name": account.name,
            "role": account.role,
            "has_password": account.password is not None,
            "created_at": account.created_at,
            "disabled_at": account.disabled_at,
        }
    )


def _link(accounts: AccountService, account: Account) -> LinkMade:
    path, expires_at = accounts.link(account)
    return LinkMade(account=_out(account), path=path, expires_at=expires_at)
