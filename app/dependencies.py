"""Dependencies of all endpoints: settings, a session that commits once and records its request, and the library of motions."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Iterator
from typing import Annotated, Any

from fastapi import Depends, Request
from sqlalchemy.orm import Session

from app.audit.requests import given_in, record, watch
from app.config import Settings
from app.db import unit_of_work
from app.problems import Unavailable
from app.store.base import Store
from app.store.motions import StoredMotions
from app.store.opening import store_of
from rths_engine.parts.ground_motions import MotionLibrary

READING = frozenset({"GET", "HEAD", "OPTIONS"})
WRITERS = 32  # requests that may write at the same time; the threads of requests are 40
READERS = 4  # requests that may read rows at the same time: each thread more delays the event loop, and with it Abort
PATIENCE_S = 60.0


def settings(request: Request) -> Settings:
    """The settings of this application."""
    found: Settings = request.app.state.settings
    return found


async def writing(request: Request) -> AsyncIterator[None]:
    """A place among the requests that may read or write at the same time. Raises Unavailable when none is free for PATIENCE_S.

    Requests wait here without a thread. The request that has the lock of the database needs a thread to end; if all threads
    waited for that lock, it would never be given back.
    """
    reads = request.method in READING
    places: asyncio.Semaphore = request.app.state.reading if reads else request.app.state.writing
    try:
        await asyncio.wait_for(places.acquire(), PATIENCE_S)
    except TimeoutError:
        what = "read" if reads else "write"
        raise Unavailable(f"Too many requests {what} at the same time. Try again in a moment.") from None
    try:
        yield
    finally:
        places.release()


def session(
    request: Request,
    _: Annotated[None, Depends(writing, scope="function")],
    __: Annotated[dict[str, Any], Depends(given_in)],
) -> Iterator[Session]:
    """A session that commits at the end of a request without errors, together with the entry of the audit log."""
    with unit_of_work(request.app.state.sessions) as one:
        made = watch(one)
        yield one
        record(one, request, made)


Configured = Annotated[Settings, Depends(settings)]
OneSession = Annotated[Session, Depends(session, scope="function")]


def store(configured: Configured) -> Store:
    """The store of recordings and other files."""
    return store_of(configured)


OneStore = Annotated[Store, Depends(store)]


def library(store: OneStore) -> MotionLibrary:
    """The library of ground motions: bundled and added records."""
    return StoredMotions(store)


Library = Annotated[MotionLibrary, Depends(library)]
