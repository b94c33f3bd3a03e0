"""What every command declares: its function, its data folder, its log."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TypeAlias

from app.logs import FORMATS, LEVELS

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def command(
    commands: Commands, name: str, function: str, about: str, recorded: bool = False, private: bool = False
) -> argparse.ArgumentParser:
    """A command. One that changes the data folder is `recorded` in the audit log.

    Only its owner may read what a `private` or recorded command writes.
    """
    made = commands.add_parser(name, help=about, description=f"{about[0].upper()}{about[1:]}.")
    made.set_defaults(function=function, recorded=recorded, private=private or recorded)
    return made


def logging(given: argparse.ArgumentParser) -> None:
    """The options of the log."""
    given.add_argument("--log-format", choices=FORMATS, help="form of the log (RTHS_LOG_FORMAT; default text)")
    given.add_argument("--log-level", choices=LEVELS, help="least level that is logged (RTHS_LOG_LEVEL; default warning)")


def data_folder(given: argparse.ArgumentParser) -> None:
    """The option of the data folder."""
    given.add_argument("--data", type=Path, metavar="DIR", help="data folder (RTHS_DATA; default rths-data)")
