"""What the separate process of `apart` runs: a reply to each file on its standard input."""

from __future__ import annotations

import os
import pickle
import sys
from typing import Any

from rths_engine.formats.registry import BY_KEY
from rths_engine.foundation.errors import FileError


def serve() -> None:
    """Reply to each file on the standard input until the input ends."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # the output of a library must not enter the replies
    while True:
        try:
            source, key = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        answer: tuple[str, Any]
        try:
            answer = ("table", BY_KEY[key].read(source))
        except FileError as refusal:
            answer = ("refused", refusal.issues)
        except Exception as error:
            answer = ("failed", error)
        pickle.dump(answer, answers)
        answers.flush()
