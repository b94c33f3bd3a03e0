"""Secret keys of sessions, API tokens and links: 256 random bits, of which only the SHA-256 is stored."""

from __future__ import annotations

import hashlib
import secrets

PREFIX = "rths_"  # by which a leaked API token is recognised


def new_key(prefix: str = "") -> str:
    """A new key as text for a header, a cookie or the part of an address behind #."""
    return prefix + secrets.token_urlsafe(32)


def sha256(key: str) -> str:
    """What is stored of a key. Keys are random, so that a fast hash without salt tells nothing about them."""
    return hashlib.sha256(key.encode()).hexdigest()
