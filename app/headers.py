"""Headers that restrict what a browser does with an answer: every answer of the service has them.

Pages allow the service's own files. Reports have styles and pictures inside, so they run in a sandbox: their scripts, which are
named by their hash, reach no cookie and no route of the service. Everything else loads nothing.
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterator

POLICY = "Content-Security-Policy"
NOTHING = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
PAGE = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; font-src 'self'; connect-src 'self'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
INLINE_STYLES = PAGE.replace(
    "style-src 'self'", "style-src 'self' 'unsafe-inline'"
)  # Plotly writes style elements and attributes
PICTURE = "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'; sandbox"
PDF = "default-src 'none'; object-src 'self'; style-src 'unsafe-inline'; frame-ancestors 'none'"  # a browser's own viewer
EVERY = {POLICY: NOTHING, "X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin"}

_SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)


def of_report(html: str) -> str:
    """The policy of a report that holds its styles, pictures and scripts: a sandbox that loads nothing."""
    scripts = " ".join(_hashes(html)) or "'none'"
    return (
        f"default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'none'; sandbox allow-scripts allow-downloads allow-modals"
    )


def of_api_docs(html: str) -> str:
    """The policy of the page of the API's documentation, which starts Swagger UI by a script inside it."""
    return INLINE_STYLES.replace("script-src 'self'", f"script-src 'self' {' '.join(_hashes(html))}")


def _hashes(html: str) -> Iterator[str]:
    for script in _SCRIPT.findall(html):
        yield f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"
