"""Passwords as argon2id hashes (RFC 9106), one computed at a time so that sign-ins leave the cores to tests."""

from __future__ import annotations

import threading

from argon2 import PasswordHasher
from argon2.exceptions import Argon2Error, InvalidHashError

from app.problems import Unavailable
from rths_engine.foundation.errors import Issue, RthsError

SHORTEST, LONGEST = 12, 200  # characters; chosen, see docs/decisions/0064
PATIENCE_S = 5.0
HASHER = PasswordHasher(time_cost=3, memory_cost=64 * 1024, parallelism=1)  # RFC 9106, section 4, on one core
_TURN = threading.Lock()
_NOBODYS: list[str] = []


def hashed(password: str, where: str = "password") -> str:
    """The hash of a new password. Raises RthsError where its length is out of range."""
    if not SHORTEST <= len(password) <= LONGEST:
        fix = "choose a longer one, such as four words" if len(password) < SHORTEST else "choose a shorter one"
        raise RthsError(Issue(where, f"needs {SHORTEST} to {LONGEST} characters", f"{len(password)} characters", fix))
    with _Turn():
        return HASHER.hash(password)


def matches(password: str, stored: str | None) -> bool:
    """Whether a password is the stored one. Without a stored one, too, a hash is computed: the time tells nothing."""
    with _Turn():
        if not _NOBODYS:
            _NOBODYS.append(HASHER.hash("a password that nobody has"))
        try:
            return HASHER.verify(stored or _NOBODYS[0], password[: LONGEST + 1]) and stored is not None
        except (Argon2Error, InvalidHashError):
            return False


class _Turn:
    """One hash at a time. Raises Unavailable after PATIENCE_S."""

    def __enter__(self) -> None:
        if not _TURN.acquire(timeout=PATIENCE_S):
            raise Unavailable("Too many people sign in at the same time. Try again in a moment.")

    def __exit__(self, *_: object) -> None:
        _TURN.release()
