"""Settings from arguments and variables."""

from __future__ import annotations

from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from app import checking
from app.config import VARIABLES, Settings, from_environment
from rths_engine.foundation.errors import RthsError
from rths_engine.running import run


@pytest.fixture(autouse=True)
def no_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    for variable in VARIABLES.values():
        monkeypatch.delenv(variable.key, raising=False)


def test_without_anything_the_service_is_this_machines_own_with_a_database_file_in_its_data_folder() -> None:
    settings = from_environment()
    assert (settings.host, settings.port, settings.data) == ("127.0.0.1", 8000, Path("rths-data"))
    assert settings.url == f"sqlite:///{Path('rths-data').resolve()}/rths.sqlite"
    assert settings.upload_limit == 20_000_000


def test_variables_are_read_and_arguments_win(monkeypatch: pytest.MonkeyPatch) -> None:
    given = {"RTHS_PORT": "8001", "RTHS_DATA": "/srv/rths", "RTHS_UPLOAD_LIMIT_MB": "5", "RTHS_HOSTS": "lab.example,lab"}
    for key, value in given.items():
        monkeypatch.setenv(key, value)
    settings = from_environment(port=9000, host=None)
    assert (settings.port, settings.data, settings.upload_limit) == (9000, Path("/srv/rths"), 5_000_000)
    assert settings.hosts == ("lab.example", "lab")


@pytest.mark.parametrize("key", ["RTHS_PORT", "RTHS_WORKERS", "RTHS_UPLOAD_LIMIT_MB"])
def test_a_variable_that_is_no_number_is_refused_by_its_name(key: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(key, "many")
    with pytest.raises(RthsError, match=f"{key} = many: needs a whole number"):
        from_environment()


def test_settings_cannot_be_changed_and_each_has_a_token_of_its_own() -> None:
    with pytest.raises(FrozenInstanceError):
        Settings().port = 1  # type: ignore[misc]
    assert Settings().worker_token != Settings().worker_token


def test_host_names_are_known_where_the_service_is_this_machines_own_or_was_told_them() -> None:
    assert {"localhost", "127.0.0.1", "::1"} == Settings().known_hosts
    assert "lab.example" in Settings(hosts=("lab.example",)).known_hosts
    assert Settings(host="0.0.0.0").known_hosts == frozenset()
    assert Settings(host="0.0.0.0", hosts=("lab.example",)).known_hosts >= {"lab.example", "localhost"}


def test_the_largest_recording_is_the_engines() -> None:
    assert checking.LARGEST_RECORDING == run.LARGEST_RECORDING
