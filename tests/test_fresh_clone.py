"""The two commands in a fresh clone, as a newcomer types them. Slow: everything is installed once more; `make test-clone`."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
from pathlib import Path

import httpx
import pytest

from tests.browser.service import until

ROOT = Path(__file__).parent.parent
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module", params=["with the machine's Node", "without Node"])
def clone(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """A clone of the last commit, and the environment to type commands in."""
    folder = tmp_path_factory.mktemp("newcomer") / "rths"
    subprocess.run(["git", "clone", "--quiet", ROOT, folder], check=True)
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", "VIRTUAL_ENV"))}
    kept["RTHS_CACHE"] = str(folder.parent / "cache")  # nothing is compiled yet
    if request.param == "without Node":
        kept["PATH"] = str(_without_node(folder.parent / "tools"))
    elif not shutil.which("npm"):
        pytest.skip("this machine has no Node")
    return folder, kept


def test_make_run_shows_a_demonstration_in_a_fresh_clone(clone: tuple[Path, dict[str, str]]) -> None:
    folder, environment = clone
    port = free_port()
    environment = {**environment, "RTHS_PORT": str(port)}
    with subprocess.Popen(
        ["make", "run"], cwd=folder, env=environment, text=True, start_new_session=True, stdout=subprocess.PIPE
    ) as made:
        try:
            assert made.stdout is not None
            assert any(f"http://127.0.0.1:{port}/" in line for line in made.stdout), "it ended without an address"
            with httpx.Client(base_url=f"http://127.0.0.1:{port}") as http:
                (run,) = http.get("/api/v1/runs").json()["runs"]
                until(lambda: http.get(f"/api/v1/runs/{run['id']}").json()["state"], lambda state: state == "running")
                for part in ("uplot/uPlot.esm.js", "htmx/htmx.min.js", "pico/pico.min.css", "swagger-ui/swagger-ui-bundle.js"):
                    assert http.get(f"/static/vendor/{part}").status_code == 200
        finally:
            os.killpg(made.pid, signal.SIGINT)
    assert (folder / "rths-data" / "rths.sqlite").exists()
    changed = subprocess.run(["git", "status", "--porcelain"], cwd=folder, capture_output=True, text=True, check=True)
    assert not changed.stdout


def test_a_second_set_up_has_nothing_to_do(clone: tuple[Path, dict[str, str]]) -> None:
    folder, environment = clone
    subprocess.run(["make", "setup"], cwd=folder, env=environment, check=True)
    again = subprocess.run(["make", "setup"], cwd=folder, env=environment, capture_output=True, text=True, check=True)
    assert "Nothing to be done" in again.stdout


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port: int = probe.getsockname()[1]
    return port


def _without_node(tools: Path) -> Path:
    """A folder with the machine's programs but for Node's."""
    tools.mkdir()
    for folder in reversed(os.environ["PATH"].split(os.pathsep)):
        for program in Path(folder).glob("*"):
            if program.name not in {"node", "nodejs", "npm", "npx", "corepack"}:
                (tools / program.name).unlink(missing_ok=True)
                (tools / program.name).symlink_to(program)
    return tools
