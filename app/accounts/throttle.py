"""Slows down guessing of passwords, for each account and for each address, without locking anybody out.

The owner of an account signs in from an address that the account has used before. Wrong passwords from other addresses
slow down those addresses only.
"""

from __future__ import annotations

import math
import time

from limits import RateLimitItem, parse
from limits.storage import MemoryStorage
from limits.strategies import MovingWindowRateLimiter

PAIR = parse("5 per 1 minute")  # wrong passwords of one account from one address
ADDRESS = parse("30 per 10 minutes")  # wrong passwords from one address
STRANGERS = parse("20 per 10 minutes")  # wrong passwords of one account from addresses that it has never used


class TooManyAttempts(Exception):
    """Too many wrong passwords; `retry_s` is the time until the next attempt is taken, s."""

    def __init__(self, retry_s: int):
        super().__init__(f"Too many wrong passwords. Try again in {retry_s} s, or ask an administrator for a password link.")
        self.retry_s = retry_s


class Throttle:
    """Counts wrong passwords in the memory of this process."""

    def __init__(self) -> None:
        self._limiter = MovingWindowRateLimiter(MemoryStorage())

    def check(self, account: str, address: str, known: bool) -> None:
        """Raise TooManyAttempts where a further attempt must wait; `known` says that the account has used the address."""
        full = [limit for limit in _limits(account, address, known) if not self._limiter.test(*limit)]
        if full:
            until = max(self._limiter.get_window_stats(*limit).reset_time for limit in full)
            raise TooManyAttempts(max(1, math.ceil(until - time.time())))

    def failed(self, account: str, address: str, known: bool) -> None:
        """Count a wrong password."""
        for limit in _limits(account, address, known):
            self._limiter.hit(*limit)

    def succeeded(self, account: str, address: str) -> None:
        """Forget the wrong passwords of an account from the address of its owner."""
        self._limiter.clear(PAIR, "pair", account, address)


def _limits(account: str, address: str, known: bool) -> list[tuple[RateLimitItem, str, *tuple[str, ...]]]:
    always: list[tuple[RateLimitItem, str, *tuple[str, ...]]] = [
        (PAIR, "pair", account, address),
        (ADDRESS, "address", address),
    ]
    return always if known else [*always, (STRANGERS, "strangers", account)]
