"""`rths`: the command line. Each command's module is imported only when it is called."""

from __future__ import annotations

import argparse
import os
import sys
from importlib import import_module
from pathlib import Path
from typing import TypeAlias

from app.logs import FORMATS, LEVELS
from app.roles import Role, Scope
from rths_engine.foundation.errors import RthsError

DONE, FAILED, UNUSABLE, INTERRUPTED = 0, 1, 2, 130
ROLES = [role.name.lower() for role in Role]
SCOPES = [scope.value for scope in Scope]
Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def main(arguments: list[str] | None = None) -> int:
    """Run one command and return its exit code."""
    given = parser().parse_args(arguments)
    module, _, function = given.function.partition(":")
    try:
        code = int(getattr(import_module(module), function)(given) or DONE)
        if code == DONE and getattr(given, "recorded", False):
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

    plan = _command(commands, "plan", "app.cli.plans:plan", "print a template as YAML, or list the templates")
    plan.add_argument(
        "name", nargs="?", metavar="NAME", help="name of the template, for example table3-04; without it, list all"
    )

    run = _command(commands, "run", "app.cli.run:run", "run a plan on this machine, without a server")
    run.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    run.add_argument("--out", type=Path, metavar="REC.h5", help="file to write the recording to (HDF5)")
    run.add_argument("--json", action="store_true", help="print the result as one JSON object")
    run.add_argument(
        "--record", metavar="FILE", help="ground motion (AT2, COSMOS V2 or columns) that replaces the plan's record"
    )
    run.add_argument("--record-unit", metavar="UNIT", help="unit of the record if its file does not state it: g, cm/s^2, ...")
    run.add_argument(
        "--record-dt", metavar="TIME", help="time step of the record if its file does not state it: 0.01, '5 ms', ..."
    )
    _data(run)

    about = "measure whether this machine meets the deadlines of a test in real time; exit code 1 where a step missed"
    deadline = _command(commands, "deadline", "app.cli.deadline:deadline", about)
    deadline.add_argument("--plan", metavar="PLAN.yaml", help="plan whose steps are executed (default: template two-storeys)")
    deadline.add_argument("--rate", type=float, metavar="HZ", help="steps a second (default: controller rate of the plan)")
    deadline.add_argument("--steps", type=int, metavar="N", help="number of steps (default: a minute)")
    deadline.add_argument("--core", type=int, metavar="C", help="core to pin the loop to, counted from 0 (default: any)")
    deadline.add_argument("--priority", type=int, metavar="P", help="real-time priority, 1 to 99 (default: ordinary)")
    deadline.add_argument("--json", action="store_true", help="print the result as one JSON object")
    _data(deadline)

    about = "let another program, such as OpenSees, drive the rig of a plan: docs/opensees-rig.md"
    rig = _command(commands, "rig", "app.cli.rig:rig", about)
    rig.add_argument("plan", metavar="PLAN.yaml", help="file with a plan of the kind client; - reads standard input")
    rig.add_argument("--listen", type=int, metavar="PORT", help="port to listen on (default: that of the plan)")
    rig.add_argument("--udp", action="store_true", help="listen by UDP (default: the transport of the plan)")
    rig.add_argument("--host", default="127.0.0.1", help="address to listen on (default %(default)s: this machine only)")
    rig.add_argument("--out", type=Path, metavar="REC.h5", help="file to write the recording to (HDF5)")
    rig.add_argument("--json", action="store_true", help="print the result as one JSON object")

    about = "simulate a plan before it is queued: would it trip, when and where, with its peaks against limits"
    preflight = _command(commands, "preflight", "app.cli.preflight:preflight", about)
    preflight.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    preflight.add_argument("--json", action="store_true", help="print the result as one JSON object")
    _data(preflight)

    about = "identify the delay of a station by a short random test of its emulated actuator and specimen"
    identify = _command(commands, "identify", "app.cli.identify:identify", about)
    identify.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    identify.add_argument("--station", type=int, default=1, metavar="N", help="station, from 1 (default %(default)s)")
    identify.add_argument("--seconds", type=float, default=20.0, help="duration of the random test (default %(default)g)")
    identify.add_argument("--low", type=float, default=0.25, metavar="HZ", help="lowest frequency (default %(default)g)")
    identify.add_argument("--high", type=float, default=6.0, metavar="HZ", help="highest frequency (default %(default)g)")
    identify.add_argument("--amplitude", metavar="LENGTH", help="peak, such as '2 mm' (default: from the limits)")
    identify.add_argument("--seed", type=int, default=0, help="seed of the random command (default %(default)s)")
    identify.add_argument("--rig", action="store_true", help="move the external rig of the station (default: its models)")
    identify.add_argument("--json", action="store_true", help="print the result as one JSON object")
    _data(identify)

    sweep = _command(commands, "sweep", "app.cli.sweep:sweep", "execute a sweep on all cores of this machine, without a server")
    sweep.add_argument("sweep", type=Path, metavar="SWEEP.yaml", help="file with the definition of the sweep: docs/sweeps.md")
    sweep.add_argument(
        "--out", type=Path, metavar="FILE", help="file to write the results to: .csv, .parquet or .arrow (default SWEEP.csv)"
    )
    sweep.add_argument("--json", action="store_true", help="also print the results as one JSON object")
    sweep.add_argument("--count", action="store_true", help="only print the number of points")
    sweep.add_argument("--processes", type=int, metavar="N", help="points at the same time (default: one for each core)")
    _data(sweep)

    stability = _command(commands, "stability", "app.cli.stability:stability", "predict whether a plan's closed loop is stable")
    stability.add_argument(
        "plan", nargs="?", metavar="PLAN.yaml", help="file with the plan; without it, print a published limit"
    )
    stability.add_argument("--json", action="store_true", help="print the result as one JSON object")

    table4 = _command(
        commands, "table4", "app.cli.table4:table4", "run the twelve simulations of Table IV and compare them with the paper"
    )
    table4.add_argument("--record", metavar="FILE", help="ground motion that replaces the bundled record")
    table4.add_argument("--record-unit", metavar="UNIT", help="unit of the record if its file does not state it (default g)")
    table4.add_argument("--record-dt", metavar="TIME", help="time step if the file does not state it (default 0.02 s)")
    table4.add_argument(
        "--factor",
        type=float,
        metavar="F",
        help="scale factor of the record (default: the factor that fits the floor peaks of simulation 2)",
    )
    table4.add_argument("--json", type=Path, metavar="OUT", help="write the table as one JSON object")

    about = "run every compensator on the virtual RTHS benchmark and on perturbed plants, and store the league"
    league = _command(commands, "league", "app.cli.league:league", about)
    league.add_argument("--case", type=int, default=1, metavar="N", help="partitioning case 1 to 4 (default %(default)s)")
    league.add_argument(
        "--record",
        default="imperial-valley-1940-el-centro-ns",
        metavar="NAME",
        help="record of the library, scaled by 0.4 (default %(default)s)",
    )
    league.add_argument("--plants", type=int, default=20, metavar="N", help="perturbed plants (default %(default)s)")
    league.add_argument("--only", nargs="+", default=[], metavar="KIND", help="kinds of compensators, for example ats inverse")
    league.add_argument("--processes", type=int, metavar="N", help="tests at the same time (default: one for each core)")
    league.add_argument(
        "--out", type=Path, metavar="OUT.json", help="file to write (default: that of the page, in the data folder)"
    )
    _data(league)

    about = "import a file of measurements, or all files of a folder or ZIP archive, as recordings"
    imports = _command(commands, "import", "app.cli.measurements:measurements", about)
    imports.add_argument(
        "file", type=Path, metavar="FILE", help="measurements, in a format of docs/formats.md; a folder or .zip of such files"
    )
    imports.add_argument("--map", type=Path, metavar="MAP.yaml", help="file with the mapping: role and unit of each column")
    imports.add_argument(
        "--out", type=Path, metavar="OUT", help="file to write the recording to (HDF5); a folder for many files"
    )
    imports.add_argument("--guess", action="store_true", help="print a proposed mapping and import nothing")
    imports.add_argument("--table", type=Path, metavar="FILE.csv", help="of many files: write the table of what differs as CSV")
    imports.add_argument(
        "--trust-mapping",
        action="store_true",
        help="of many files: take the units and the step of the mapping where most files state others",
    )

    diagnose = _command(
        commands,
        "diagnose",
        "app.cli.diagnose:diagnose",
        "compare a recording with a plan and name the physics that its models leave out",
    )
    diagnose.add_argument("plan", metavar="PLAN.yaml", help="file with the plan to check; linear: a fitted linear model")
    diagnose.add_argument("recording", type=Path, metavar="REC.h5", help="recording of the stations of the plan")
    diagnose.add_argument(
        "--holdout", type=Path, nargs="+", default=[], metavar="REC.h5", help="held-out recordings: tested, not fitted"
    )
    diagnose.add_argument(
        "--with", dest="more", type=Path, nargs="+", default=[], metavar="REC.h5", help="further recordings to fit"
    )
    diagnose.add_argument("--level", type=float, default=0.01, metavar="P", help="false-alarm rate (default %(default)s)")
    diagnose.add_argument("--json", type=Path, metavar="OUT", help="write the verdict as one JSON object")
    diagnose.add_argument("--report", type=Path, metavar="OUT", help="write the report: OUT.html or OUT.pdf")

    report = _command(commands, "report", "app.cli.report:report", "write the report of a recording file or of a run")
    report.add_argument("subject", metavar="RECORDING.h5", help="recording file, or the identifier of a run in the data folder")
    forms = report.add_mutually_exclusive_group()
    forms.add_argument("--html", action="store_true", help="one HTML file below 1 MB (default)")
    forms.add_argument("--pdf", action="store_true", help="PDF")
    forms.add_argument("--mat", action="store_true", help="the recording as a MATLAB file")
    forms.add_argument("--designsafe", action="store_true", help="data set for DesignSafe as a ZIP archive; needs --metadata")
    report.add_argument("--metadata", type=Path, metavar="FILE.yaml", help="metadata of the data set: docs/reports.md")
    report.add_argument("--out", type=Path, metavar="OUT", help="file to write (default: named after the recording)")
    _data(report)

    prove = _command(
        commands, "prove", "app.cli.prove:prove", "score diagnoses on generated recordings with known left-out physics"
    )
    prove.add_argument("--cases", type=int, default=100, metavar="N", help="number of recordings (default %(default)s)")
    prove.add_argument("--seed", type=int, default=0, metavar="S", help="seed of the cases (default %(default)s)")
    prove.add_argument("--workers", type=int, default=2, metavar="N", help="diagnoses at the same time (default %(default)s)")
    prove.add_argument(
        "--only", metavar="KIND/LEVEL", help="cases of one kind of test, of one level, or of both; KIND/EFFECT: of one effect"
    )
    prove.add_argument("--keep", type=Path, metavar="DIR", help="folder to store plans, recordings, truths and verdicts in")
    prove.add_argument("--json", type=Path, required=True, metavar="OUT", help="write every score as one JSON object")
    prove.add_argument(
        "--reliability", type=Path, metavar="OUT.svg", help="draw the share of right names against their probability"
    )
    prove.add_argument(
        "--certificate", action="store_true", help="also write the error rates that verdicts cite into the engine"
    )
    prove.add_argument(
        "--calibrate",
        action="store_true",
        help="only fit the map of probabilities to these cases and write it into the engine",
    )
    prove.add_argument(
        "--picture", type=Path, metavar="OUT.svg", help="plot the rates against the strength of the left-out physics"
    )
    prove.add_argument("--table", action="store_true", help="also print a row for each effect")

    scores = _command(
        commands, "scores", "app.cli.scores:scores", "fit models to published measurements and compare with published errors"
    )
    scores.add_argument("folder", type=Path, metavar="FOLDER", help="folder with the data sets of docs/scores.md")
    scores.add_argument("--json", type=Path, metavar="OUT", help="write every score as one JSON object")

    serve = _command(commands, "serve", "app.cli.serve:serve", "start the control room")
    _data(serve)
    serve.add_argument("--host", help="address to listen on (RTHS_HOST; default 127.0.0.1: this machine only)")
    serve.add_argument("--port", type=int, help="port to listen on (RTHS_PORT; default 8000)")
    serve.add_argument(
        "--tls-certificate", type=Path, metavar="PEM", help="certificate: answer https (RTHS_TLS_CERTIFICATE; default http)"
    )
    serve.add_argument("--tls-key", type=Path, metavar="PEM", help="key of the certificate (RTHS_TLS_KEY)")
    serve.add_argument("--demo", action="store_true", help="queue a demonstration test, unless one is queued or running")
    serve.add_argument(
        "--local", action="store_true", help="sign in everyone on this computer as administrator; only at a loopback address"
    )
    serve.add_argument("--no-worker", action="store_true", help="start no worker; tests wait for `rths worker`")

    _logging(serve)

    worker = _command(
        commands, "worker", "app.cli.worker:worker", "execute queued tests and diagnoses, beside `rths serve --no-worker`"
    )
    _data(worker)
    worker.add_argument("--web", default="ws://127.0.0.1:8000", help="address of the control room (default %(default)s)")
    worker.add_argument("--ca", type=Path, metavar="PEM", help="certificates to trust at wss:// addresses (RTHS_CA)")
    worker.add_argument("--name", help="name of this worker (default: the machine)")
    worker.add_argument("--workers", type=int, metavar="N", help="tests at the same time (RTHS_WORKERS; default 2)")
    _logging(worker)

    _operation(commands)
    _migrate_store(commands)
    _library(commands)
    _audit(commands)
    _accounts(commands)
    _data(_command(commands, "motions", "app.cli.plans:motions", "list the ground-motion records"))
    _command(commands, "version", "app.cli.plans:version", "print the version")
    return top


def _library(commands: Commands) -> None:
    top = commands.add_parser("library", help="list, show, save and compare plans in the library of a data folder")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)

    listed = _command(actions, "list", "app.cli.library:listed", "list the plans in the library")
    listed.add_argument("text", nargs="?", default="", metavar="TEXT", help="only plans with this text in name, tag or comment")
    listed.add_argument("--tag", default="", metavar="TAG", help="only plans with this tag")
    listed.add_argument("--archived", action="store_true", help="list the archived plans instead")

    show = _command(actions, "show", "app.cli.library:show", "print a version of a plan as YAML")
    show.add_argument("plan", metavar="PLAN[@VERSION]", help="name in the library; without a version, the newest")
    show.add_argument("--history", action="store_true", help="print number, time, author and comment of every version instead")

    save = _command(
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

    diff = _command(
        actions, "diff", "app.cli.library:diff", "compare two plans field by field; the exit code is 1 where they differ"
    )
    for name in ("first", "second"):
        diff.add_argument(name, metavar=f"{name.upper()}", help="PLAN, PLAN@VERSION or a YAML file")
    for command in (listed, show, save, diff):
        _data(command)


def _audit(commands: Commands) -> None:
    top = commands.add_parser("audit", help="check, export and note the audit log of a data folder: docs/audit.md")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)

    about = "check that no entry was changed, removed or added in between; exit code 1 where the chain is broken"
    check = _command(actions, "check", "app.cli.audit:check", about)
    check.add_argument("--head", metavar="NUMBER:HASH", help="head that was noted earlier: the chain must still contain it")

    head = _command(actions, "head", "app.cli.audit:head", "print number and hash of the last entry, to note them elsewhere")
    export = _command(actions, "export", "app.cli.audit:export", "write every entry as a line of JSON")
    export.add_argument("--out", type=Path, metavar="FILE.jsonl", help="file to write (default: standard output)")
    for command in (check, head, export):
        _data(command)


def _accounts(commands: Commands) -> None:
    """`rths account` and `rths token`."""
    top = commands.add_parser("account", help="add, list and change the accounts of a control room")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)
    at = "app.cli.accounts:"
    link = _command(actions, "link", f"{at}link", "print the one-time link to make the first administrator", recorded=True)
    add = _command(actions, "add", f"{at}add", "add an account, and print the link to choose its password", recorded=True)
    listed = _command(actions, "list", f"{at}listed", "list the accounts with role and state")
    role = _command(actions, "role", f"{at}role", "give an account another role", recorded=True)
    disable = _command(
        actions, "disable", f"{at}disable", "end what an account has open, and refuse its sign-in", recorded=True
    )
    password = _command(actions, "password-link", f"{at}password_link", "print a link to choose a new password", recorded=True)
    for command in (add, role, disable, password):
        command.add_argument("name", metavar="NAME", help="name of the account")
    add.add_argument("--role", choices=ROLES, default="viewer", help="what the account may do (default %(default)s)")
    role.add_argument("role", choices=ROLES, help="what the account may do from now on")
    disable.add_argument("--undo", action="store_true", help="enable the account again")
    for command in (link, add, password):
        command.add_argument("--url", metavar="URL", help="address of the control room for the link (default: this computer)")

    top = commands.add_parser("token", help="add, list and revoke the API tokens of an account")
    actions = top.add_subparsers(dest="action", metavar="ACTION", required=True)
    new = _command(actions, "add", f"{at}token_add", "make an API token of an account", recorded=True)
    tokens = _command(actions, "list", f"{at}token_list", "list the API tokens of an account")
    revoke = _command(actions, "revoke", f"{at}token_revoke", "end an API token", recorded=True)
    for command in (new, tokens, revoke):
        command.add_argument("account", metavar="ACCOUNT", help="name of the account")
    new.add_argument("name", metavar="NAME", help="what the token is for")
    new.add_argument("--scope", action="append", choices=SCOPES, help="what the token may do; can be repeated (default read)")
    new.add_argument("--days", type=int, choices=range(1, 367), default=90, metavar="N", help="days that it holds (default 90)")
    revoke.add_argument("token", metavar="ID", help="id of the token, as `rths token list` prints it")
    for command in (link, add, listed, role, disable, password, new, tokens, revoke):
        _data(command)


def _migrate_store(commands: Commands) -> None:
    about = "move all rows and files to another database and store, and compare them; can be resumed: docs/scaled-mode.md"
    moving = _command(commands, "migrate-store", "app.cli.migrate_store:migrate_store", about)
    for word, name, what in (("from", "source", "that is moved"), ("to", "target", "to move to")):
        moving.add_argument(f"--{word}", dest=name, type=Path, metavar="FOLDER", help=f"data folder {what} (SQLite and files)")
        moving.add_argument(f"--{word}-database", metavar="URL", help=f"or the PostgreSQL database {what}")
        moving.add_argument(f"--{word}-store", metavar="URL", help=f"with its store {what}: s3://bucket/prefix, file:///folder")
    moving.add_argument("--accept-damaged", action="store_true", help="move files that are damaged or missing as they are")


def _operation(commands: Commands) -> None:
    about = "bring the database to the newest schema, or to an earlier one"
    migrate = _command(commands, "migrate", "app.cli.migrating:migrate", about, recorded=True)
    migrate.add_argument("--to", metavar="REVISION", help="schema to go to, such as 0018 (default: the newest)")
    migrate.add_argument(
        "--accept-loss", action="store_true", help="go to an earlier schema although it has no place for some data"
    )
    about = "copy all rows and files of one moment into a new folder, also while the control room runs: docs/operation.md"
    backup = _command(commands, "backup", "app.cli.backup:backup", about)
    backup.add_argument("to", type=Path, metavar="TO", help="folder of backups; files that the newest one has are linked")
    about = "restore a backup into an empty data folder and database; nothing is overwritten"
    restore = _command(commands, "restore", "app.cli.backup:restore", about)
    restore.add_argument("backup", type=Path, metavar="FROM", help="folder of one backup")
    about = "check every stored file against its row, and list files without a row; exit code 1 where a file is damaged"
    verify = _command(commands, "verify", "app.cli.backup:verify", about)
    about = "remove the recordings that the rule of retention removes, without waiting for the day: docs/operation.md"
    retention = _command(commands, "retention", "app.cli.retention:retention", about, recorded=True)
    retention.add_argument("--dry-run", action="store_true", help="only say how many recordings go, how large and which first")
    for command in (migrate, backup, restore, verify, retention):
        _data(command)


def _command(commands: Commands, name: str, function: str, about: str, recorded: bool = False) -> argparse.ArgumentParser:
    """A command; one that changes the data folder is `recorded` in the audit log."""
    command = commands.add_parser(name, help=about, description=f"{about[0].upper()}{about[1:]}.")
    command.set_defaults(function=function, recorded=recorded)
    return command


def _logging(command: argparse.ArgumentParser) -> None:
    command.add_argument("--log-format", choices=FORMATS, help="form of the log (RTHS_LOG_FORMAT; default text)")
    command.add_argument("--log-level", choices=LEVELS, help="least level that is logged (RTHS_LOG_LEVEL; default warning)")


def _data(command: argparse.ArgumentParser) -> None:
    command.add_argument("--data", type=Path, metavar="DIR", help="data folder (RTHS_DATA; default rths-data)")
