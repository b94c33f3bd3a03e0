"""Tables of the command line, from its parser."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from app.cli.main import parser
from app.documents.markdown import code, table


def commands() -> str:
    """Every command, in one line each."""
    return table(["command", "does"], [(code(_usage(one)), str(one.description)) for _, one in _all(parser())])


def options() -> str:
    """Every option and argument of every command."""
    parts = []
    for name, command in _all(parser()):
        rows = [(code(_written(one)), _help(one)) for one in command._actions if one.dest != "help"]
        text = f"### rths{name}\n\n{command.description}\n\n`{_usage(command)}`"
        parts.append(f"{text}\n\n{table(['option', 'meaning'], rows)}" if rows else text)
    return "\n\n".join(parts)


def _all(top: argparse.ArgumentParser, name: str = "") -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Every command below `top` that is no group of commands, with the name that follows `rths`."""
    for action in top._actions:
        if isinstance(action, argparse._SubParsersAction):
            for own, command in action.choices.items():
                yield from _all(command, f"{name} {own}")
            return
    yield name, top


def _usage(command: argparse.ArgumentParser) -> str:
    return " ".join(command.format_usage().removeprefix("usage: ").replace("[-h] ", "").replace(" [-h]", "").split())


def _written(action: argparse.Action) -> str:
    name = ", ".join(action.option_strings)
    value = "" if action.nargs == 0 else action.metavar or action.dest.upper()
    return f"{name} {value}".strip()


def _help(action: argparse.Action) -> str:
    return str(action.help) % vars(action)
