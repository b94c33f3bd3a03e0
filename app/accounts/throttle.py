"""Slows down guessing of passwords, for each account and for each address, without locking anybody out.

The owner of an account signs in from an address that the account has used before. Neither wrong passwords from other addresses
nor those of other people behind the same address slow that down.
"""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from limits import RateLimitItem, parse
from limits.storage import MemoryStorage
from limits.strategies import MovingWindowRateLimiter

PAIR = parse("5 per 1 minute")  # wrong passwords of one account from one address
ADDRESS = parse("30 per 10 minutes")  # wrong passwords from one address of accounts that have never used it
STRANGERS = parse("20 per 10 minutes")  # wrong passwords of one account from addresses that it has never used

Limit = tuple[RateLimitItem, str, *tuple[str, ...]]


class TooManyAttempts(Exception):
    """Too many wrong passwords; `retry_s` is the time until the next attempt is taken, s."""

    def __init__(self, retry_s: int):
        super().__init__(f"Too many wrong passwords. Try again in {retry_s} s, or ask an administrator for a password link.")
        self.retry_s = retry_s


@dataclass(slots=True)
class Attempt:
    """One attempt: whether its password was correct, None until that is known."""

    correct: bool | None = None


class Throttle:
    """Counts wrong passwords in the memory of this process.

    An attempt counts from its start, before the slow hash is computed, so that attempts at the same time are as few as attempts
    one after another. The count is given back where the password is correct or was not looked at.
    """

    def __init__(self) -> None:
        self._limiter = MovingWindowRateLimiter(MemoryStorage())
        self._under_way: Counter[str] = Counter()
        self._lock = threading.Lock()

    @contextmanager
    def attempt(self, account: str, address: str, known: bool) -> Iterator[Attempt]:
        """An attempt whose outcome the block stores in it; `known` says that the account has used the address before.

        Raises TooManyAttempts where a further attempt must wait.
        """
        limits = _limits(account, address, known)
        with self._lock:
            self._check(limits)
            self._under_way.update(map(_key, limits))
        attempt = Attempt()
        try:
            yield attempt
        finally:
            with self._lock:
                self._settle(limits, attempt.correct)

    def _check(self, limits: list[Limit]) -> None:
        full = [limit for limit in limits if not self._limiter.test(*limit, cost=1 + self._under_way[_key(limit)])]
        if full:
            wrong = [limit for limit in full if not self._limiter.test(*limit)]  # the others wait for attempts under way
            until = max((self._limiter.get_window_stats(*limit).reset_time for limit in wrong), default=0.0)
            raise TooManyAttempts(max(1, math.ceil(until - time.time())))

    def _settle(self, limits: list[Limit], correct: bool | None) -> None:
        for limit in limits:
            self._under_way[_key(limit)] -= 1
            if correct is False:
                self._limiter.hit(*limit)
            elif correct and limit[0] is PAIR:
                self._limiter.clear(*limit)
        self._under_way += Counter()  # without what is zero


def _key(limit: Limit) -> str:
    return limit[0].key_for(*limit[1:])


def _limits(account: str, address: str, known: bool) -> list[Limit]:
    pair: Limit = (PAIR, "pair", account, address)
    return [pair] if known else [pair, (ADDRESS, "address", address), (STRANGERS, "strangers", account)]
