"""What a worker trusts when it connects to a web service by TLS."""

from __future__ import annotations

import ssl
from pathlib import Path
from urllib.parse import urlsplit

from app.config import LOOPBACK, from_environment
from rths_engine.foundation.errors import Issue, RthsError


def context(url: str) -> ssl.SSLContext | None:
    """The TLS context for an address; None for one without TLS. Raises RthsError for a file that holds no certificate.

    RTHS_CA names the certificates to trust instead of those of the system. The embedded worker connects to this computer, and
    trusts the certificate of its own web service, whatever name it is made out to.
    """
    parts, settings = urlsplit(url), from_environment()
    if parts.scheme != "wss":
        return None
    if settings.tls_certificate is not None and parts.hostname in LOOPBACK | {settings.host}:
        found = _trusting(settings.tls_certificate)
        found.check_hostname = False
        found.verify_flags |= ssl.VERIFY_X509_PARTIAL_CHAIN
        return found
    return _trusting(settings.ca) if settings.ca is not None else ssl.create_default_context()


def _trusting(path: Path) -> ssl.SSLContext:
    try:
        return ssl.create_default_context(cafile=path)
    except OSError as error:  # also SSLError
        fix = "give a file of certificates in PEM form"
        raise RthsError(Issue("certificates", f"cannot be read: {error.strerror or error}", str(path), fix)) from None
