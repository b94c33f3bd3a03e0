"""Scaled mode as it runs: PostgreSQL, an S3 server, two web services, two workers with folders of their own; one is killed.

Takes a minute or more, so it runs by name only: pytest -m slow tests/app/test_scaled.py.
"""

from __future__ import annotations

import hashlib
import json
import os
import signal
import ssl
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest
import sqlalchemy as sa
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app import db
from app.models import Run
from app.worker.trust import context
from tests.app import postgres
from tests.app.conftest import plan
from tests.app.test_tls import made
from tests.browser.service import ROOT, UNMEASURED, free_port, until

pytestmark = pytest.mark.slow
PATIENCE_S = 300
BUCKET, PREFIX = "laboratory", "rths"
SLOW = {"kind": "real_time", "factor": 1.0}


@dataclass
class Laboratory:
    """The addresses of the web services, the processes of the workers by name, and the environment of all of them."""

    folder: Path
    environment: dict[str, str]
    webs: list[httpx.Client] = field(default_factory=list)
    addresses: list[str] = field(default_factory=list)
    workers: dict[str, subprocess.Popen[bytes]] = field(default_factory=dict)

    def get(self, path: str, web: int = 0) -> Any:
        return self.webs[web].get(f"/api/v1{path}").raise_for_status().json()

    def submit(self, web: int, **changes: Any) -> str:
        answer = self.webs[web].post("/api/v1/runs", json={"plan": plan(**changes), "submitted_by": "Ana"})
        assert answer.status_code == 201, answer.text
        found: str = answer.json()["runs"][0]["id"]
        return found

    def wait(self, run: str, state: str, web: int = 0) -> dict[str, Any]:
        found: dict[str, Any] = until(
            lambda: self.get(f"/runs/{run}", web), lambda one: one["state"] in (state, "failed", "cancelled"), PATIENCE_S
        )
        assert found["state"] == state, found["reason"]
        return found

    def start(self, *arguments: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "app.cli", *arguments]
        return subprocess.Popen(command, cwd=ROOT, env=self.environment)


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Laboratory]:
    reason = postgres.missing()
    if reason:
        pytest.skip(reason)
    folder = tmp_path_factory.mktemp("scaled")
    certificate = made(folder / "web.pem", "localhost")
    with ExitStack() as stack:
        database, endpoint = stack.enter_context(postgres.server()), stack.enter_context(s3())
        given = {"RTHS_DATABASE_URL": database, "RTHS_STORE": f"s3://{BUCKET}/{PREFIX}", "RTHS_STORE_ENDPOINT": endpoint}
        keys = {"AWS_ACCESS_KEY_ID": "key", "AWS_SECRET_ACCESS_KEY": "secret", "AWS_DEFAULT_REGION": "us-east-1"}
        one = Laboratory(folder, {**UNMEASURED, **given, **keys, "RTHS_WORKER_TOKEN": "a token of the laboratory"})
        ports = free_port(), free_port()
        tls = ["--tls-certificate", str(certificate)]
        for number, (port, more) in enumerate(zip(ports, ([], tls), strict=True), start=1):
            data = ["--data", str(folder / f"web-{number}"), "--port", str(port)]
            stack.callback(ended, one.start("serve", "--no-worker", "--local", *data, *more))
            one.addresses.append(f"wss://localhost:{port}" if more else f"ws://127.0.0.1:{port}")
            url = f"https://localhost:{port}" if more else f"http://127.0.0.1:{port}"
            one.webs.append(
                httpx.Client(base_url=url, timeout=60, verify=ssl.create_default_context(cafile=certificate) if more else True)
            )
        for number in range(2):
            until(partial(answers, one, number), bool, PATIENCE_S)
        for name in ("first", "second"):
            web = ["--web", ",".join(one.addresses), "--ca", str(certificate)]
            process = one.start("worker", "--name", name, "--workers", "1", "--data", str(folder / name), *web)
            one.workers[name] = process
            stack.callback(ended, process)
        yield one
        for client in one.webs:
            client.close()


def answers(laboratory: Laboratory, number: int) -> bool:
    try:
        return bool(laboratory.webs[number].get("/api/v1/queue").is_success)
    except httpx.HTTPError:
        return False


def ended(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait(60)


@contextmanager
def s3() -> Iterator[str]:
    """The address of an S3 server on this computer, with an empty bucket."""
    from moto.server import ThreadedMotoServer

    port = free_port()
    server = ThreadedMotoServer(ip_address="127.0.0.1", port=port, verbose=False)
    server.start()
    try:
        bucket(f"http://127.0.0.1:{port}").create_bucket(Bucket=BUCKET)
        yield f"http://127.0.0.1:{port}"
    finally:
        server.stop()


def bucket(endpoint: str) -> Any:
    import boto3

    known = {"aws_access_key_id": "key", "aws_secret_access_key": "secret", "region_name": "us-east-1"}
    return boto3.client("s3", endpoint_url=endpoint, **known)


def executing(laboratory: Laboratory, run: str) -> str:
    """The worker that executes a run."""
    engine = db.connect(laboratory.environment["RTHS_DATABASE_URL"])
    with db.sessions(engine)() as session:
        found = session.scalar(sa.select(Run.worker).where(Run.id == run))
    engine.dispose()
    return found or ""


def watched(laboratory: Laboratory, run: str, web: int) -> set[str]:
    """The kinds of message that a viewer of a web service gets until 100 buckets have come; `frames` is the binary kind."""
    url = f"{laboratory.addresses[web]}/api/v1/runs/{run}/live"
    told, seen = set(), 0
    os.environ["RTHS_CA"] = str(laboratory.folder / "web.pem")
    try:
        with connect(url, ssl=context(url), max_size=None) as socket:
            for message in socket:
                if isinstance(message, bytes):
                    told.add("frames")
                    seen += int.from_bytes(message[4:8], "little")
                    if seen >= 100:
                        break
                else:
                    told.add(json.loads(message)["type"])
    except ConnectionClosed:
        pass
    finally:
        del os.environ["RTHS_CA"]
    return told


def test_runs_finish_and_show_everywhere_though_a_worker_is_killed(laboratory: Laboratory) -> None:
    record = "\n".join(str(value) for value in (0.0, 0.1, -0.1, 0.05, 0.0) * 100)
    sent = {"file": ("mine.txt", record)}
    about = {"unit": "m/s^2", "dt": "0.02", "name": "mine"}
    answer = laboratory.webs[0].post("/api/v1/motions", files=sent, data=about)
    assert answer.status_code == 201, answer.text
    assert "mine" in [one["name"] for one in laboratory.get("/motions", web=1)["motions"]]
    motion = {**plan()["motion"], "record": "mine", "sha256": answer.json()["sha256"]}
    runs = [laboratory.submit(number % 2, seed=number, motion=motion) for number in range(4)]
    watched_run = laboratory.submit(1, pace=SLOW, duration=20.0)
    laboratory.wait(watched_run, "running")
    for web in (0, 1):
        assert {"schema", "frames"} <= watched(laboratory, watched_run, web)
    (name,) = [one for one in laboratory.workers if executing(laboratory, watched_run).startswith(one)]
    laboratory.workers[name].send_signal(signal.SIGKILL)
    found = laboratory.wait(watched_run, "completed", web=1)
    assert found["attempt"] == 2
    endpoint = laboratory.environment["RTHS_STORE_ENDPOINT"]
    listed = bucket(endpoint).list_objects_v2(Bucket=BUCKET, Prefix=f"{PREFIX}/recordings/")["Contents"]
    expected = {f"{PREFIX}/recordings/{run}.h5" for run in (*runs, watched_run)}
    for run in (*runs, watched_run):
        recording = laboratory.wait(run, "completed")["recording"]
        for web in (0, 1):
            content = laboratory.webs[web].get(f"/api/v1/runs/{run}/recording.h5").raise_for_status().content
            assert hashlib.sha256(content).hexdigest() == recording["sha256"]
    assert {one["Key"] for one in listed} == expected
    for folder in ("first", "second", "web-1", "web-2"):
        assert not list((laboratory.folder / folder / "recordings").glob("*.h5"))  # nothing lies beside the store


def test_an_object_that_was_altered_in_the_bucket_is_not_served(laboratory: Laboratory) -> None:
    run = laboratory.submit(0, seed=9)
    laboratory.wait(run, "completed")
    client = bucket(laboratory.environment["RTHS_STORE_ENDPOINT"])
    client.put_object(Bucket=BUCKET, Key=f"{PREFIX}/recordings/{run}.h5", Body=b"altered")
    answer = laboratory.webs[0].get(f"/api/v1/runs/{run}/recording.h5")
    assert answer.status_code == 409 and "is damaged" in answer.json()["detail"]
