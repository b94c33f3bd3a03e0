"""TLS between web service and workers: the certificate is checked, and unusable files say so before anything starts."""

from __future__ import annotations

import socket
import ssl
import threading
from argparse import Namespace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID

from app.cli.serve import address, check_certificate
from app.cli.settings import settings as settings_of
from app.config import Settings, from_environment
from app.worker.trust import context
from rths_engine.foundation.errors import RthsError


@pytest.fixture(scope="session")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A certificate that is made out to `localhost` and signs itself, with its key in the same file."""
    return made(tmp_path_factory.mktemp("tls") / "server.pem", "localhost")


def made(path: Path, host: str) -> Path:
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, host)])
    now = datetime.now(UTC)
    signed = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(1)
        .not_valid_before(now - timedelta(hours=1))
        .not_valid_after(now + timedelta(days=1))
        .add_extension(x509.SubjectAlternativeName([x509.DNSName(host)]), critical=False)
        .sign(key, hashes.SHA256())
    )
    plain = serialization.NoEncryption()
    private = key.private_bytes(serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, plain)
    path.write_bytes(private + signed.public_bytes(serialization.Encoding.PEM))
    return path


def shaken(certificate: Path, trusted: ssl.SSLContext, host: str) -> str:
    """The version of TLS after a handshake with a server that has the certificate. Raises SSLError."""
    server = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    server.load_cert_chain(certificate)
    ours, theirs = socket.socketpair()

    def answer() -> None:
        try:
            server.wrap_socket(theirs, server_side=True).close()
        except OSError:
            theirs.close()

    thread = threading.Thread(target=answer)
    thread.start()
    try:
        with trusted.wrap_socket(ours, server_hostname=host) as secured:
            return secured.version() or ""
    finally:
        ours.close()
        thread.join()


@pytest.mark.parametrize("host", ["localhost", "rths.example"])
def test_a_worker_trusts_the_certificates_that_it_is_given_for_their_names(
    host: str, certificate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert context("ws://rths.example:8000") is None
    url = "wss://rths.example:8000"
    default = context(url)
    assert default is not None
    with pytest.raises(ssl.SSLCertVerificationError):
        shaken(certificate, default, host)
    monkeypatch.setenv("RTHS_CA", str(certificate))
    trusted = context(url)
    assert trusted is not None
    if host == "localhost":
        assert shaken(certificate, trusted, host).startswith("TLS")
    else:
        with pytest.raises(ssl.SSLCertVerificationError, match="Hostname mismatch"):
            shaken(certificate, trusted, host)


def test_the_embedded_worker_trusts_the_certificate_of_its_own_service_only(
    certificate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RTHS_TLS_CERTIFICATE", str(certificate))
    trusted = context("wss://127.0.0.1:8000")
    assert trusted is not None and shaken(certificate, trusted, "127.0.0.1").startswith("TLS")
    with pytest.raises(ssl.SSLCertVerificationError):
        shaken(made(tmp_path / "other.pem", "localhost"), trusted, "127.0.0.1")


def test_a_certificate_makes_the_address_https_and_one_that_cannot_be_used_is_refused(
    certificate: Path, tmp_path: Path
) -> None:
    good = Settings(tls_certificate=certificate)
    check_certificate(good)
    assert address(good) == "https://127.0.0.1:8000/"
    (tmp_path / "text.pem").write_text("no certificate")
    wrong: list[tuple[Settings, str]] = [
        (Settings(tls_certificate=tmp_path / "none.pem"), "No such file"),
        (Settings(tls_certificate=tmp_path / "text.pem"), "--tls-certificate"),
        (Settings(tls_key=certificate), "--tls-key.*without a certificate"),
    ]
    for settings, problem in wrong:
        with pytest.raises(RthsError, match=problem):
            check_certificate(settings)
    given = Namespace(tls_certificate=certificate, tls_key=None)
    assert settings_of(given).tls_certificate == certificate


def test_a_file_without_certificates_is_refused_before_the_worker_starts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RTHS_CA", str(tmp_path / "none.pem"))
    with pytest.raises(RthsError, match="certificates"):
        context("wss://rths.example:8000")


def test_a_secret_may_lie_in_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "token").write_text("from a file\n")
    monkeypatch.delenv("RTHS_WORKER_TOKEN", raising=False)
    monkeypatch.setenv("RTHS_WORKER_TOKEN_FILE", str(tmp_path / "token"))
    assert from_environment().worker_token == "from a file"
    monkeypatch.setenv("RTHS_WORKER_TOKEN", "from the environment")
    assert from_environment().worker_token == "from the environment"
    monkeypatch.setenv("RTHS_DATABASE_URL_FILE", str(tmp_path / "none"))
    with pytest.raises(RthsError, match=r"RTHS_DATABASE_URL_FILE.*No such file"):
        from_environment()
