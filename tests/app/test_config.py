"""Settings from arguments and variables."""

from __future__ import annotations

import socket
import threading
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from app import checking, config, own_names
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


def test_host_names_are_those_of_this_machine_or_those_that_the_service_was_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(config, "own_names", lambda: frozenset({"control-room", "control-room.lab.example"}))
    loopback = {"localhost", "127.0.0.1", "::1"}
    assert Settings().known_hosts == loopback
    assert Settings(hosts=("Lab.example",)).known_hosts == loopback | {"lab.example"}
    for host in ("0.0.0.0", "::", "10.0.0.4"):
        on_network = Settings(host=host)
        own = {"control-room", "control-room.lab.example"} | ({host} if host == "10.0.0.4" else set())
        assert on_network.known_hosts == loopback | own and on_network.by_any_address
        told = Settings(host=host, hosts=("lab.example",))
        assert told.known_hosts == (loopback | {"lab.example", host}) - {"0.0.0.0", "::"} and not told.by_any_address


def test_the_names_of_this_machine_are_asked_for_with_patience(monkeypatch: pytest.MonkeyPatch) -> None:
    released = threading.Event()
    monkeypatch.setattr(own_names, "PATIENCE_S", 0.01)
    monkeypatch.setattr(socket, "gethostname", lambda: "Hall-2.lab.example")
    monkeypatch.setattr(socket, "getfqdn", lambda: str(released.wait(30)))
    own_names.own_names.cache_clear()
    assert own_names.own_names() == {"hall-2.lab.example", "hall-2", "hall-2.local"}
    released.set()
    own_names.own_names.cache_clear()


@pytest.mark.parametrize(
    ("host", "is_one"), [("10.0.0.4", True), ("fe80::1", True), ("10.0.0.4.lab.example", False), (None, False)]
)
def test_an_ip_address_is_told_from_a_name(host: str | None, is_one: bool) -> None:
    assert own_names.is_address(host) is is_one


def test_the_largest_recording_is_the_engines() -> None:
    assert checking.LARGEST_RECORDING == run.LARGEST_RECORDING
