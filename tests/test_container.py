"""The Dockerfile, read as text: no container engine is needed to keep it honest."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent
INSTRUCTIONS = re.sub(r"\\\n\s*", "", (ROOT / "Dockerfile").read_text()).splitlines()


def values(instruction: str) -> list[str]:
    return [line.split(maxsplit=1)[1] for line in INSTRUCTIONS if line.startswith(f"{instruction} ")]


def test_the_program_is_built_by_make_setup_and_nothing_else() -> None:
    system, built, user = values("RUN")
    assert system.startswith("apt-get update") and system.endswith("--no-install-recommends make")
    assert built.split()[-2:] == ["make", "setup"]
    assert user.startswith("useradd")


def test_it_runs_as_a_user_of_its_own_who_owns_the_data() -> None:
    (user,) = values("USER")
    assert user not in {"root", "0"}
    assert f"chown -R {user} /data /opt/rths/cache" in values("RUN")[-1]
    assert values("VOLUME") == ["/data"]


def test_it_is_watched_by_its_own_health_address() -> None:
    (check,) = values("HEALTHCHECK")
    assert "/healthz" in check


def test_what_make_setup_needs_is_not_ignored() -> None:
    ignored = (ROOT / ".dockerignore").read_text().split()
    for needed in (
        "Makefile",
        "pyproject.toml",
        "requirements.lock",
        "frontend",
        "app",
        "rths_engine",
        "migrations",
        "README.md",
    ):
        assert needed not in ignored and (ROOT / needed).exists()


def test_the_cache_of_the_build_is_the_one_it_runs_with() -> None:
    assert "RTHS_CACHE=/opt/rths/cache" in values("RUN")[1]
    assert "RTHS_CACHE=/opt/rths/cache" in values("ENV")[0]
