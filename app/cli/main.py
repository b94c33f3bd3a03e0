"""`rths`: the command line. Each command's module is imported only when it is called."""

from __future__ import annotations

import argparse
import os
import sys
from contextlib import nullcontext
from importlib import import_module

from app import private
from app.cli import commands_of_recordings, commands_of_records, commands_of_service, commands_of_tests
from app.cli.command import command, data_folder
from app.imports import uncollected
from rths_engine.foundation.errors import RthsError

DONE, FAILED, UNUSABLE, INTERRUPTED = 0, 1, 2, 130


def main(arguments: list[str] | None = None) -> int:
    """Run one command and return its exit code."""
    given = parser().parse_args(arguments)
    module, _, function = given.function.partition(":")
    try:
        with private.writing() if given.private else nullcontext():
            with uncollected():
                loaded = import_module(module)
            code = int(getattr(loaded, function)(given) or DONE)
            if code == DONE and given.recorded:
                import_module("app.cli.recorded").record(given)
        return code
    except RthsError as error:
        for issue in error.issues:
            print(f"rths {given.command}: {issue}", file=sys.stderr)
            for line in issue.lines:
                print(f"  {line.number:>6} | {line.text}", file=sys.stderr)
        return UNUSABLE
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:  # the reader of the output, such as head, has closed it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE


def parser() -> argparse.ArgumentParser:
    """The parser of every command and option."""
    top = argparse.ArgumentParser(prog="rths", description="Control room for real-time hybrid simulation.")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)
    commands_of_tests.add(commands)
    commands_of_recordings.add(commands)
    commands_of_service.services(commands)
    commands_of_service.operation(commands)
    commands_of_service.migrate_store(commands)
    commands_of_records.library(commands)
    commands_of_records.audit(commands)
    commands_of_records.accounts(commands)
    data_folder(command(commands, "motions", "app.cli.plans:motions", "list the ground-motion records"))
    command(commands, "version", "app.cli.plans:version", "print the version")
    return top
