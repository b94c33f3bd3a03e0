"""Why the exchange with a client ends."""

from __future__ import annotations


class Ended(Exception):
    """The end of a test with a client. The message is the sentence for people; `orderly` where the client ended it itself."""

    def __init__(self, sentence: str, orderly: bool = False, cause: str = "client"):
        super().__init__(sentence)
        self.orderly, self.cause = orderly, cause


class Gone(Exception):
    """The connection to the client is closed."""
