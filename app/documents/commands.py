"""Tables of the command line, from its parser."""

from __future__ import annotations

import argparse

from app.cli.main import parser
from app.documents.markdown import code, table


def commands() -> str:
    """Every command, in one line each."""
    return table(["command", "does"], [(code(_usage(one)), str(one.description)) for one in _subparsers().choices.values()])


def options() -> str:
    """Every option and argument of every command."""
    parts = []
    for name, command in _subparsers().choices.items():
        rows = [(code(_written(one)), _help(one)) for one in command._actions if one.dest != "help"]
        text = f"### rths {name}\n\n{command.description}\n\n`{_usage(command)}`"
        parts.append(f"{text}\n\n{table(['option', 'meaning'], rows)}" if rows else text)
    return "\n\n".join(parts)


def _subparsers() -> argparse._SubParsersAction[argparse.ArgumentParser]:
    (found,) = (one for one in parser()._actions if isinstance(one, argparse._SubParsersAction))
    return found


def _usage(command: argparse.ArgumentParser) -> str:
    return " ".join(command.format_usage().removeprefix("usage: ").replace("[-h] ", "").replace(" [-h]", "").split())


def _written(action: argparse.Action) -> str:
    name = ", ".join(action.option_strings)
    value = "" if action.nargs == 0 else action.metavar or action.dest.upper()
    return f"{name} {value}".strip()


def _help(action: argparse.Action) -> str:
    return str(action.help) % vars(action)
