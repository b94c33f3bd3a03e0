"""Check the licences of all parts: permissive licences are allowed, any other needs a named reason.

Copyleft is allowed in optional extras and in tools for tests. The product itself holds only libraries that it loads unchanged
at run time and that anybody can replace. Each is named below with its reason; a reason that is no longer needed is reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from license_expression import AND, OR, ExpressionError, Licensing, get_spdx_licensing

from app.supply_chain.parts import UNKNOWN, Part

ALLOWED = {
    "MIT",
    "MIT-0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "0BSD",
    "ISC",
    "PSF-2.0",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "Zlib",
    "CC0-1.0",
    "Unlicense",
    "BSL-1.0",
}


@dataclass(frozen=True)
class Reason:
    """Why a part with another licence is there."""

    licence: str
    use: str
    why: str


REASONS = {
    "psycopg": Reason("LGPL-3.0-only", "product", "DBOS requires this driver of PostgreSQL; loaded unchanged at run time."),
    "psycopg-binary": Reason("LGPL-3.0-only", "product", "The compiled half of psycopg, with PostgreSQL's own client library."),
    "certifi": Reason("MPL-2.0", "product", "HTTPX requires this list of certificate authorities; unchanged."),
    "orjson": Reason("MPL-2.0 AND (Apache-2.0 OR MIT)", "product", "pymseed requires it; unchanged."),
    "python-dateutil": Reason("Dual License", "product", "A choice of Apache-2.0 and BSD-3-Clause; unchanged."),
    "tqdm": Reason("MPL-2.0 AND MIT", "product", "Progress of long commands; unchanged."),
    "asammdf": Reason("LGPL-3.0-or-later", "formats", "The only maintained reader of ASAM MDF; decision 0027."),
    "nptdms": Reason("LGPL-3.0-only", "formats", "The only complete reader of NI TDMS; decision 0027."),
    "epicscorelibs": Reason("EPICS", "epics", "The EPICS libraries, under their own permissive licence."),
    "codespell": Reason("GPL-2.0-only", "tests", "Checks the spelling of the sources; never installed with the product."),
    "fqdn": Reason("MPL-2.0", "tests", "Checks the schema of the list of parts; never installed with the product."),
    "hypothesis": Reason("MPL-2.0", "tests", "Makes inputs of tests; never installed with the product."),
    "pathspec": Reason("MPL-2.0", "tests", "mypy requires it; never installed with the product."),
}


def problems(found: Sequence[Part], reasons: dict[str, Reason] = REASONS) -> list[str]:
    """What is wrong with the licences of the parts, one sentence each."""
    wrong = []
    for part in found:
        reason, licence = reasons.get(part.name), f"{part.name} {part.version} ({part.use}) is licensed {part.licence}"
        if not refused(part.licence):
            if reason:
                wrong.append(f"{licence}, which needs no reason: remove its line from REASONS.")
        elif reason is None:
            wrong.append(f"{licence}: not in the allow list, and without a reason.")
        elif (reason.licence, reason.use) != (part.licence, part.use):
            wrong.append(f"{licence}; its reason is for {reason.licence} ({reason.use}).")
    missing = sorted(set(reasons) - {one.name for one in found})
    return wrong + [f"{name} has a line in REASONS, but is not installed." for name in missing]


@lru_cache
def refused(licence: str) -> bool:
    """Whether an SPDX expression leaves no choice of allowed licences."""
    if licence == UNKNOWN:
        return True
    try:
        return not _allowed(_spdx().parse(licence, validate=True))
    except ExpressionError:
        return True


@lru_cache(maxsize=1)
def _spdx() -> Licensing:
    return get_spdx_licensing()


def _allowed(term: object) -> bool:
    if isinstance(term, OR):
        return any(_allowed(one) for one in term.args)
    if isinstance(term, AND):
        return all(_allowed(one) for one in term.args)
    return str(term) in ALLOWED


def table(found: Sequence[Part]) -> list[str]:
    """A line for each part: name, version, licence and use."""
    return [f"{one.name:28} {one.version:16} {one.licence:40} {one.use}" for one in found]
