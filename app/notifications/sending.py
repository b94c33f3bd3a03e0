"""One delivery to a webhook: the JSON of an event, signed with HMAC-SHA256, sent by POST."""

from __future__ import annotations

import hashlib
import hmac
import json
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

import httpx

from rths_engine import __version__

TIMEOUT_S = 5.0
BACK_OFF = tuple(timedelta(seconds=seconds) for seconds in (5, 30, 120, 600, 3600))
"""Pauses before the second and further attempts; a delivery fails when they are used up."""
TEST = {"kind": "test", "about": "webhook", "sentence": "A test of this webhook."}


@dataclass(frozen=True, slots=True)
class Parcel:
    """What is sent, and where to; free of the session that read it."""

    number: int
    url: str
    secret: str
    content: dict[str, Any]
    attempts: int


@dataclass(frozen=True, slots=True)
class Sent:
    """How an attempt went: the HTTP status, and the problem if it was not accepted."""

    status: int | None
    problem: str | None


def signature(secret: str, timestamp: str, body: bytes) -> str:
    """HMAC-SHA256 of `timestamp.body` with the secret, as hexadecimal digits."""
    return hmac.new(secret.encode(), timestamp.encode() + b"." + body, hashlib.sha256).hexdigest()


def send(parcel: Parcel) -> Sent:
    """Send a delivery. A status of 200 to 299 accepts it; redirects are not followed."""
    body = json.dumps(parcel.content).encode()
    timestamp = str(int(datetime.now(UTC).timestamp()))
    headers = {
        "Content-Type": "application/json",
        "User-Agent": f"rths-control-room/{__version__}",
        "X-RTHS-Event": str(parcel.content["event"]["kind"]),
        "X-RTHS-Delivery": str(parcel.number),
        "X-RTHS-Timestamp": timestamp,
        "X-RTHS-Signature": f"sha256={signature(parcel.secret, timestamp, body)}",
    }
    try:
        answer = httpx.post(parcel.url, content=body, headers=headers, timeout=TIMEOUT_S, follow_redirects=False)
    except (httpx.HTTPError, httpx.InvalidURL, ValueError) as error:
        return Sent(None, f"{type(error).__name__}: {error}"[:500])
    if answer.is_success:
        return Sent(answer.status_code, None)
    return Sent(answer.status_code, f"The address answered with the HTTP status {answer.status_code}.")
