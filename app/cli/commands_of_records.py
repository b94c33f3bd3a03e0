"""Commands on what a control room keeps beside tests: the library of plans, the audit log, accounts and API tokens."""

from __future__ import annotations

from pathlib import Path

from app.cli.command import Commands, command, data_folder
from app.roles import Role, Scope

ROLES = [role.name.lower() for role in Role]
SCOPES = [scope.value for scope in Scope]


def library(commands: Commands) -> None:
    """`rths library`."""
    top = commands.add_parser("library", help="list, show, save and compare plans in the library of a data folder")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)

    listed = command(actions, "list", "app.cli.library:listed", "list the plans in the library")
    listed.add_argument("text", nargs="?", default="", metavar="TEXT", help="only plans with this text in name, tag or comment")
    listed.add_argument("--tag", default="", metavar="TAG", help="only plans with this tag")
    listed.add_argument("--archived", action="store_true", help="list the archived plans instead")

    show = command(actions, "show", "app.cli.library:show", "print a version of a plan as YAML")
    show.add_argument("plan", metavar="PLAN[@VERSION]", help="name in the library; without a version, the newest")
    show.add_argument("--history", action="store_true", help="print number, time, author and comment of every version instead")

    save = command(
        actions,
        "save",
        "app.cli.library:save",
        "save a plan to the library, as a new plan or as the next version of a plan",
        recorded=True,
    )
    save.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    save.add_argument("--name", metavar="NAME", help="name in the library (default: the name in the plan)")
    save.add_argument("--comment", default="", metavar="TEXT", help="what changed in this version")
    save.add_argument("--tag", action="append", default=[], metavar="TAG", help="tag of a new plan; can be repeated")
    save.add_argument("--by", metavar="PERSON", help="author (default: the user of this computer)")

    diff = command(
        actions, "diff", "app.cli.library:diff", "compare two plans field by field; the exit code is 1 where they differ"
    )
    for name in ("first", "second"):
        diff.add_argument(name, metavar=f"{name.upper()}", help="PLAN, PLAN@VERSION or a YAML file")
    for each in (listed, show, save, diff):
        data_folder(each)


def audit(commands: Commands) -> None:
    """`rths audit`."""
    top = commands.add_parser("audit", help="check, export and note the audit log of a data folder: docs/audit.md")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)

    about = "check that no entry was changed, removed or added in between; exit code 1 where the chain is broken"
    check = command(actions, "check", "app.cli.audit:check", about)
    check.add_argument("--head", metavar="NUMBER:HASH", help="head that was noted earlier: the chain must still contain it")

    head = command(actions, "head", "app.cli.audit:head", "print number and hash of the last entry, to note them elsewhere")
    export = command(actions, "export", "app.cli.audit:export", "write every entry as a line of JSON")
    export.add_argument("--out", type=Path, metavar="FILE.jsonl", help="file to write (default: standard output)")
    for each in (check, head, export):
        data_folder(each)


def accounts(commands: Commands) -> None:
    """`rths account` and `rths token`."""
    top = commands.add_parser("account", help="add, list and change the accounts of a control room")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)
    at = "app.cli.accounts:"
    link = command(actions, "link", f"{at}link", "print the one-time link to make the first administrator", recorded=True)
    add = command(actions, "add", f"{at}add", "add an account, and print the link to choose its password", recorded=True)
    listed = command(actions, "list", f"{at}listed", "list the accounts with role and state")
    role = command(actions, "role", f"{at}role", "give an account another role", recorded=True)
    disable = command(actions, "disable", f"{at}disable", "end what an account has open, and refuse its sign-in", recorded=True)
    password = command(actions, "password-link", f"{at}password_link", "print a link to choose a new password", recorded=True)
    for each in (add, role, disable, password):
        each.add_argument("name", metavar="NAME", help="name of the account")
    add.add_argument("--role", choices=ROLES, default="viewer", help="what the account may do (default %(default)s)")
    role.add_argument("role", choices=ROLES, help="what the account may do from now on")
    disable.add_argument("--undo", action="store_true", help="enable the account again")
    for each in (link, add, password):
        each.add_argument("--url", metavar="URL", help="address of the control room for the link (default: this computer)")

    top = commands.add_parser("token", help="add, list and revoke the API tokens of an account")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)
    new = command(actions, "add", f"{at}token_add", "make an API token of an account", recorded=True)
    tokens = command(actions, "list", f"{at}token_list", "list the API tokens of an account")
    revoke = command(actions, "revoke", f"{at}token_revoke", "end an API token", recorded=True)
    for each in (new, tokens, revoke):
        each.add_argument("account", metavar="ACCOUNT", help="name of the account")
    new.add_argument("name", metavar="NAME", help="what the token is for")
    new.add_argument("--scope", action="append", choices=SCOPES, help="what the token may do; can be repeated (default read)")
    new.add_argument("--days", type=int, choices=range(1, 367), default=90, metavar="N", help="days that it holds (default 90)")
    revoke.add_argument("token", metavar="ID", help="id of the token, as `rths token list` prints it")
    for each in (link, add, listed, role, disable, password, new, tokens, revoke):
        data_folder(each)
