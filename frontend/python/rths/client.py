"""Queue tests, sweeps and diagnoses of a control room, wait for them and read their results.

from rths.client import Client

lab = Client("http://127.0.0.1:8000", by="Ana Ruiz")
run = lab.wait(lab.submit("table3-04"))
recording = lab.recording(run)
recording["x_meas.1"], recording.dataframe()
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

import httpx
from tqdm import tqdm

from rths.errors import ClientError, NotCompleted, Problem, Refused, TooLong, Unreachable
from rths.jobs import Diagnosis, Job, Run, Sweep
from rths.recording import Recording, SweepResults

__all__ = ["Client", "ClientError", "NotCompleted", "Problem", "Refused", "TooLong", "Unreachable"]

AnyJob = TypeVar("AnyJob", bound=Job)
Plan = Mapping[str, Any] | str | Path
POLL_S = 0.2
PAGE = 500  # runs of one request; the service allows no more


class Client:
    """A connection to the control room at `url`.

    `token` is an API token, by default that of the environment variable RTHS_TOKEN; its account is stored with the jobs. A
    control room without accounts needs no token, and stores the name `by`.
    """

    def __init__(self, url: str = "http://127.0.0.1:8000", by: str = "", timeout_s: float = 60.0, token: str | None = None):
        self.by = by
        token = os.environ.get("RTHS_TOKEN", "") if token is None else token
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._http = httpx.Client(base_url=url.rstrip("/") + "/api/v1", timeout=timeout_s, headers=headers)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Close the connection. Jobs go on."""
        self._http.close()

    # Plans

    def templates(self) -> list[str]:
        """Names of the templates."""
        return [one["name"] for one in self._json("GET", "/templates")["templates"]]

    def plan(self, plan: Plan) -> dict[str, Any]:
        """A plan as JSON in SI units: from the name of a template, from the path of a YAML file, or the plan itself."""
        if not isinstance(plan, Mapping | str | Path):
            given = type(plan).__name__
            raise ClientError(f"a plan is a mapping, the name of a template or the path of a YAML file, not {given}")
        if isinstance(plan, Mapping):
            return dict(plan)
        if isinstance(plan, str) and not plan.endswith((".yaml", ".yml")):
            return dict(self._json("GET", f"/templates/{plan}")["plan"])
        try:
            text = Path(plan).read_bytes()
        except OSError as error:
            raise ClientError(f"the plan {plan} cannot be read: {error.strerror}") from error
        return dict(self._json("POST", "/plans/read", content=text, headers={"Content-Type": "application/yaml"}))

    def check(self, plan: Plan) -> dict[str, Any]:
        """The plan with every default, its digest, warnings and summary. Raises Refused with each error of the plan."""
        return dict(self._json("POST", "/plans/check", json=self.plan(plan)))

    # Runs

    def submit(self, plan: Plan) -> Run:
        """Queue a test."""
        return self._submit({"plan": self.plan(plan)})[0]

    def submit_many(self, plans: Sequence[Plan]) -> list[Run]:
        """Queue tests, all or none. At most 500 in one call; use a sweep for more."""
        return self._submit({"plans": [self.plan(plan) for plan in plans]})

    def _submit(self, body: dict[str, Any]) -> list[Run]:
        return [Run.of(one) for one in self._json("POST", "/runs", json=body | {"submitted_by": self.by})["runs"]]

    def run(self, run_id: str) -> Run:
        """A run by its identifier."""
        return Run.of(self._json("GET", f"/runs/{run_id}"))

    def runs(self, **query: Any) -> Iterator[Run]:
        """All runs that the query of `GET /runs` selects, for example `state="tripped"`, in its order."""
        offset = 0
        while page := self._json("GET", "/runs", params={**query, "limit": PAGE, "offset": offset})["runs"]:
            yield from (Run.of(one) for one in page)
            offset += len(page)

    def recording(self, run: Run | str) -> Recording:
        """The recording of a run in SI units."""
        return Recording.of(self._answer("GET", f"/runs/{_id(run)}/recording.h5").content)

    # Sweeps

    def sweep(self, definition: Mapping[str, Any]) -> Sweep:
        """Queue a sweep, `rths-sweep/1`: see docs/sweeps.md."""
        body = {"sweep": dict(definition), "submitted_by": self.by}
        return Sweep.of(self._json("POST", "/sweeps", json=body))

    def preview(self, definition: Mapping[str, Any]) -> dict[str, Any]:
        """Number of points, predicted time and stability of a sweep, without queueing it."""
        return dict(self._json("POST", "/sweeps/preview", json=dict(definition)))

    def results(self, sweep: Sweep | str) -> SweepResults:
        """Results so far of a sweep in columns, in the units shown."""
        found = self._json("GET", f"/sweeps/{_id(sweep)}/results")
        return SweepResults(found["values"], found["columns"])

    # Diagnoses

    def diagnose(
        self,
        recording: Run | str,
        plan: Plan | None = None,
        heldout: Sequence[Run | str] = (),
        level: float = 0.01,
        name: str = "",
    ) -> Diagnosis:
        """Queue a diagnosis of a run's or an imported recording (its identifier) with a plan, by default the run's own.

        `heldout` recordings are never fitted; `level` is the false-alarm rate.
        """
        body: dict[str, Any] = {
            "recording": _source(recording),
            "heldout": [_source(one) for one in heldout],
            "level": level,
            "name": name,
            "submitted_by": self.by,
        }
        if plan is not None:
            body["plan"] = self.plan(plan)
        return Diagnosis.of(self._json("POST", "/diagnoses", json=body))

    def verdict(self, diagnosis: Diagnosis | str) -> dict[str, Any]:
        """The verdict of a completed diagnosis, `rths-diagnosis/1`."""
        return dict(self._json("GET", f"/diagnoses/{_id(diagnosis)}/verdict.json"))

    # Jobs of every kind

    def wait(self, job: AnyJob, progress: bool = True, within_s: float | None = None, completed: bool = False) -> AnyJob:
        """Wait until a job has ended, and return the job as it is then.

        `progress` shows a bar. Raises TooLong after `within_s` and, with `completed`, NotCompleted if the job ended otherwise.
        """
        start = time.monotonic()
        layout = "{l_bar}{bar}| {elapsed}{postfix}"
        with tqdm(total=1.0, desc=job.name, disable=not progress, bar_format=layout) as bar:
            while True:
                job = self.renewed(job)
                bar.n = 1.0 if job.state in {"completed", "tripped"} else job.share
                bar.set_postfix_str(job.state if job.ended else job.doing)
                if job.ended:
                    break
                if within_s is not None and time.monotonic() - start > within_s:
                    raise TooLong(f"{job.name} is {job.state} after {within_s:g} s; the job goes on")
                time.sleep(POLL_S)
        if completed and job.state != "completed":
            raise NotCompleted(job)
        return job

    def renewed(self, job: AnyJob) -> AnyJob:
        """The job as it is now."""
        return type(job).of(self._json("GET", f"/{job.route}/{job.id}"))

    def cancel(self, job: AnyJob) -> AnyJob:
        """Cancel a queued or running job."""
        return type(job).of(self._json("POST", f"/{job.route}/{job.id}/cancel", json={"by": self.by}))

    def abort(self) -> dict[str, Any]:
        """Stop every running test and hold the queue; what the workers have acknowledged and whether the hold is recorded."""
        found: dict[str, Any] = self._json("POST", "/abort", json={"by": self.by})
        return found

    def aborted(self) -> dict[str, Any]:
        """What is known of Abort now, as `abort` returns it."""
        found: dict[str, Any] = self._json("GET", "/abort")
        return found

    def _json(self, method: str, path: str, **request: Any) -> Any:
        return self._answer(method, path, **request).json()

    def _answer(self, method: str, path: str, **request: Any) -> httpx.Response:
        try:
            asked = self._http.build_request(method, path, **request)
        except (TypeError, ValueError) as error:
            raise ClientError(
                f"the request cannot be sent as JSON, which has text, finite numbers, lists and mappings: {error}"
            ) from error
        try:
            answer = self._http.send(asked)
        except httpx.HTTPError as error:
            at = self._http.base_url
            raise Unreachable(f"no answer from {at}: {error}. Is the control room running there (rths serve)?") from error
        if answer.is_error:
            raise _refused(answer)
        return answer


def _refused(answer: httpx.Response) -> Refused:
    try:
        said = answer.json()
        problems = [Problem(one["where"], one["problem"], one.get("value"), one.get("fix")) for one in said["errors"]]
        return Refused(answer.status_code, said["detail"], problems)
    except (ValueError, KeyError, TypeError):
        return Refused(answer.status_code, f"HTTP status {answer.status_code} from {answer.url}", [])


def _id(job: Job | str) -> str:
    return job if isinstance(job, str) else job.id


def _source(recording: Run | str) -> dict[str, str]:
    """A run's recording, or an imported recording by its identifier."""
    return {"run": recording.id} if isinstance(recording, Run) else {"recording": recording}
