"""The declaration of a format: how it is recognised and read, what its header states, and what is compared with the data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from rths_engine.formats.source import Source
from rths_engine.formats.table import Table


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """A format of files. docs/formats.md is generated from these fields.

    `defined` names the definition of the format; `header` lists what is read from its header, `compared` what is compared with
    the data; `public` is the number of public files that were read as an independent reader or their own header says, with the
    check described in `public_check`. `apart`: its library can crash on a damaged file, so that a separate process reads it.
    """

    key: str
    title: str
    of: Literal["ground motion", "measurement", "both"]
    extensions: tuple[str, ...]
    defined: str
    header: str
    compared: str
    looks_like: Callable[[Source], bool]
    read: Callable[[Source], Table]
    library: str = ""
    public: int = 0
    public_check: str = ""
    apart: bool = False
