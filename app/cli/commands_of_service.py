"""Commands that run and keep the control room: services, workers, backups, migrations and moves."""

from __future__ import annotations

from pathlib import Path

from app.cli.command import Commands, command, data_folder, logging


def services(commands: Commands) -> None:
    """`rths serve` and `rths worker`."""
    serve = command(commands, "serve", "app.cli.serve:serve", "start the control room", private=True)
    data_folder(serve)
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

    logging(serve)

    about = "execute queued tests and diagnoses, beside `rths serve --no-worker`"
    worker = command(commands, "worker", "app.cli.worker:worker", about, private=True)
    data_folder(worker)
    worker.add_argument("--web", default="ws://127.0.0.1:8000", help="address of the control room (default %(default)s)")
    worker.add_argument("--ca", type=Path, metavar="PEM", help="certificates to trust at wss:// addresses (RTHS_CA)")
    worker.add_argument("--name", help="name of this worker (default: the machine)")
    worker.add_argument("--workers", type=int, metavar="N", help="tests at the same time (RTHS_WORKERS; default 2)")
    logging(worker)


def operation(commands: Commands) -> None:
    """`rths migrate`, `backup`, `restore`, `send-recordings`, `verify` and `retention`."""
    about = "bring the database to the newest schema, or to an earlier one"
    migrate = command(commands, "migrate", "app.cli.migrating:migrate", about, recorded=True)
    migrate.add_argument("--to", metavar="REVISION", help="schema to go to, such as 0018 (default: the newest)")
    migrate.add_argument(
        "--accept-loss", action="store_true", help="go to an earlier schema although it has no place for some data"
    )
    about = "copy all rows and files of one moment into a new folder, also while the control room runs: docs/operation.md"
    backup = command(commands, "backup", "app.cli.backup:backup", about, private=True)
    backup.add_argument("to", type=Path, metavar="TO", help="folder of backups; files that the newest one has are linked")
    about = "restore a backup into an empty data folder and database; nothing is overwritten"
    restore = command(commands, "restore", "app.cli.backup:restore", about, private=True)
    restore.add_argument("backup", type=Path, metavar="FROM", help="folder of one backup")
    about = "attach recordings that their worker could not send to their runs; `rths worker` does so at its start"
    sending = command(commands, "send-recordings", "app.cli.sending:send_recordings", about, recorded=True)
    sending.add_argument(
        "folder", type=Path, nargs="?", metavar="FOLDER", help="folder `unsent` of a worker (default: that of the data folder)"
    )
    about = "check every stored file against its row, and list files without a row; exit code 1 where a file is damaged"
    verify = command(commands, "verify", "app.cli.backup:verify", about)
    about = "remove the recordings that the rule of retention removes, without waiting for the day: docs/operation.md"
    retention = command(commands, "retention", "app.cli.retention:retention", about, recorded=True)
    retention.add_argument("--dry-run", action="store_true", help="only say how many recordings go, how large and which first")
    for each in (migrate, backup, restore, sending, verify, retention):
        data_folder(each)


def migrate_store(commands: Commands) -> None:
    """`rths migrate-store`."""
    about = "move all rows and files to another database and store, and compare them; can be resumed: docs/scaled-mode.md"
    moving = command(commands, "migrate-store", "app.cli.migrate_store:migrate_store", about, private=True)
    for word, name, what in (("from", "source", "that is moved"), ("to", "target", "to move to")):
        moving.add_argument(f"--{word}", dest=name, type=Path, metavar="FOLDER", help=f"data folder {what} (SQLite and files)")
        moving.add_argument(f"--{word}-database", metavar="URL", help=f"or the PostgreSQL database {what}")
        moving.add_argument(f"--{word}-store", metavar="URL", help=f"with its store {what}: s3://bucket/prefix, file:///folder")
    moving.add_argument("--accept-damaged", action="store_true", help="move files that are damaged or missing as they are")
