"""`rths serve`: the control room, until Ctrl-C."""

from __future__ import annotations

import errno
import fcntl
import os
import socket
import ssl
import sys
from argparse import Namespace
from contextlib import nullcontext, suppress
from typing import IO, Any

import uvicorn
from fastapi import FastAPI

from app import logs
from app.accounts.service import AccountService
from app.cli.connections import Bounded, allow_files, bound_waiting
from app.cli.main import DONE, FAILED
from app.cli.settings import stored
from app.config import ANY, Settings
from app.db import unit_of_work
from app.demonstration import queue_demonstration
from app.main import create_app
from app.memory import share_arenas, spare_the_collector
from app.moving.places import using
from rths_engine.foundation.errors import Issue, RthsError

GRACE_S = 2
SWITCH_S = 0.001  # after which a thread of a request leaves the interpreter to the event loop: Abort waits for it
LOCK = "control-room.lock"
PROXIES = "FORWARDED_ALLOW_IPS"  # addresses of proxies whose X-Forwarded-For and -Proto are believed; uvicorn's name for it


def serve(given: Namespace) -> int:
    """`rths serve`: run the control room until Ctrl-C; returns the exit code."""
    settings = stored(given, embedded_worker=not given.no_worker, local_sign_in=given.local)
    if settings.local_sign_in and settings.on_network:
        fix = "leave out --local and give each person an account: docs/accounts.md"
        raise RthsError(Issue("host", "can be reached from other computers, where --local is not allowed", settings.host, fix))
    logs.configure(settings.log_format, settings.log_level)
    check_certificate(settings)
    with using(settings), only_server(settings) if settings.embedded_worker else nullcontext():
        return _serve(settings, given.demo)


def _serve(settings: Settings, demonstrate: bool) -> int:
    listening = listen(settings)
    allow_files()
    share_arenas()
    sys.setswitchinterval(SWITCH_S)
    server = Server(create_app(settings), settings, demonstrate)
    with suppress(KeyboardInterrupt):
        server.run(sockets=[listening])
    if not server.started:
        return FAILED
    print("\nStopped.")
    return DONE


QUIET: dict[str, Any] = {"log_config": None, "access_log": False}
LIVE: dict[str, Any] = {"ws_per_message_deflate": False}
"""Options of websockets: live values compress badly, and compressing them for each viewer costs more than it saves."""


class Server(uvicorn.Server):
    """The web server; when the service answers, it queues the demonstration if asked and prints the address."""

    def __init__(self, app: FastAPI, settings: Settings, demonstrate: bool):
        # app/logs.py and app/observing.py write what these two would
        tls = {"ssl_certfile": settings.tls_certificate, "ssl_keyfile": settings.tls_key}
        trusted = {"forwarded_allow_ips": os.environ.get(PROXIES, "")}  # uvicorn's own default is this computer
        given: dict[str, Any] = {"timeout_graceful_shutdown": GRACE_S, "http": Bounded, **QUIET, **LIVE, **tls, **trusted}
        super().__init__(uvicorn.Config(app, **given))
        self.app, self.settings, self.demonstrate = app, settings, demonstrate

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if not self.started:
            return
        self.app.state.calculations.processes.start()
        spare_the_collector()
        if self.demonstrate:
            queue_demonstration(self.app)
        print(f"\nRTHS control room: {address(self.settings)}")
        if self.settings.on_network:
            print(reachable(self.settings), end="")
        if self.settings.local_sign_in:
            print("Everyone on this computer is signed in as administrator. For accounts, start it without --local.")
        else:
            print(_first(self.app, self.settings), end="")
        print(f"Data folder: {self.settings.data.resolve()}\nPress Ctrl-C to stop the control room.", flush=True)


def reachable(settings: Settings) -> str:
    """For which hosts a service on a network answers, and a warning where passwords pass the network unencrypted."""
    addresses = " and for every IP address" if settings.by_any_address else ""
    said = f"Answers for the host names {', '.join(sorted(settings.known_hosts))}{addresses}. Others: RTHS_HOSTS=NAME,NAME\n"
    if settings.tls_certificate or os.environ.get(PROXIES):
        return said
    warning = "Warning: browsers on other computers send passwords unencrypted, because the service answers plain http."
    return f"{said}{warning}\nGive a certificate with --tls-certificate, or use a proxy with TLS: docs/scaled-mode.md\n"


def _first(app: FastAPI, settings: Settings) -> str:
    """How to make the first administrator, until there is an account."""
    with unit_of_work(app.state.sessions) as session:
        accounts = AccountService(session)
        if accounts.any():
            return ""
        path, expires_at = accounts.link()
    link, other = (f"{one.rstrip('/')}{path}" for one in (address(settings), address(settings, elsewhere=True)))
    also = f"From another computer: {other}\n" if other != link else ""
    return f"First administrator: {link}\n{also}The link works once, until {expires_at:%Y-%m-%d %H:%M} UTC.\n"


def listen(settings: Settings) -> socket.socket:
    """A socket at the address of the service. Raises RthsError when the port is in use or the address can't be used."""
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    found = socket.socket(family, socket.SOCK_STREAM)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bound_waiting(found)
    try:
        found.bind((settings.host, settings.port))
        found.listen()
    except OSError as error:
        found.close()
        raise RthsError(_unusable(settings, error)) from None
    return found


def check_certificate(settings: Settings) -> None:
    """Raise RthsError where the certificate and the key of the service cannot be used."""
    if settings.tls_certificate is None:
        if settings.tls_key is not None:
            fix = "give the certificate with --tls-certificate"
            raise RthsError(Issue("--tls-key", "is given without a certificate", str(settings.tls_key), fix))
        return
    try:
        ssl.create_default_context(ssl.Purpose.CLIENT_AUTH).load_cert_chain(settings.tls_certificate, settings.tls_key)
    except OSError as error:  # also SSLError
        fix = "give the certificate and its key as PEM files"
        problem = f"cannot be used: {error.strerror or error}"
        raise RthsError(Issue("--tls-certificate", problem, str(settings.tls_certificate), fix)) from None


def only_server(settings: Settings) -> IO[str]:
    """A file whose lock keeps a second control room from the same data folder. Raises RthsError when one runs already.

    Two of them would execute the jobs of each other's queue, and each would keep the other's workers for dead.
    """
    file = (settings.prepared().data / LOCK).open("a+")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        file.close()
        fix = "stop it first, choose another folder with --data, or start this one with --no-worker"
        raise RthsError(Issue("data", "is in use by another control room", str(settings.data.resolve()), fix)) from None
    return file


def address(settings: Settings, elsewhere: bool = False) -> str:
    """The URL of the service for a browser on this machine, or on another one: there it needs the name of this machine."""
    here = (settings.hosts[0] if settings.hosts else socket.gethostname().lower()) if elsewhere else "127.0.0.1"
    host = here if settings.host in ANY else settings.host
    scheme = "https" if settings.tls_certificate else "http"
    return f"{scheme}://[{host}]:{settings.port}/" if ":" in host else f"{scheme}://{host}:{settings.port}/"


def _unusable(settings: Settings, error: OSError) -> Issue:
    if error.errno == errno.EADDRINUSE:
        other = settings.port + 1
        fix = f"stop the program that listens there, or choose another: RTHS_PORT={other} make run, rths serve --port {other}"
        return Issue("port", "is in use by another program", settings.port, fix)
    return Issue(
        "host", f"can't listen on this address: {error.strerror}", f"{settings.host}:{settings.port}", "choose another --host"
    )
