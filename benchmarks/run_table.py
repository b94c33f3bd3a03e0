"""Time of the run table with many runs: `python -m benchmarks.run_table [--runs 100000] [--url postgresql://...]`.

Fills a new database with runs like those of a laboratory. Then asks the service by REST for pages near and far down of each
column to sort by, and for the first page of each kind of filter. Prints the median and the 95th percentile of the time, and the
size of the answer. `--only mte_mm:1` measures the pages of this column only; `--data FOLDER`, or a `--url` that has runs
already, measures the same runs again.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from fastapi.testclient import TestClient

from app import db
from app.config import Settings
from app.jobs import queue
from app.main import create_app
from app.memory import spare_the_collector
from app.models import Run, RunPlan, RunStation
from app.runs import values
from app.runs.columns import FACTS
from rths_engine.planning import templates
from rths_engine.planning.reading import read_plan
from rths_engine.results.measure import StationMeasure
from rths_engine.results.measures import of

BATCH = 1000
REPEATS = 9
PAGE = 100
CLOCK = time.process_time if "--cpu" in sys.argv else time.perf_counter
FIRST = datetime(2024, 1, 1, tzinfo=UTC)
PEOPLE = ("Ana Ruiz", "Bo Chen", "Chidi Okafor", "Dana Levi", "Eun-ji Park")
TAGS = ("calibration", "paper", "rejected", "student", "rig 2")
STATES = ("completed",) * 17 + ("tripped",) * 2 + ("cancelled",)

SORTS = (
    *FACTS,
    *("mte_mm:1", "mte_mm:2", "mte_mm:max", "floors_peak_mm:max", "mte_mm:7"),
    *("plan.motion.scale.factor", "plan.stations.0.compensator.alpha_es", "plan.stations.0.compensator.kind"),
    *("plan.structure.storeys.1.stiffness", "plan.controller_rate"),
)
PAGES = ((0, 100), (0, 500), (10_000, 100), (50_000, 100), (90_000, 100), (94_000, 500))  # offset and number of rows
FILTERS = (
    *("", "state=tripped", "state=completed", "name~17", "name~no such run", "tag=paper", "tag=", "template=table3-04"),
    *("submitted_by=Ana Ruiz", "submitted_at<2024-02-01", "elapsed_s>39.9", "reason~station 2", "test=structure"),
    *("mte_mm:1<0.5", "mte_mm:max>20", "mte_mm:1=", "mte_mm:2<0.01"),
    *("plan.stations.0.compensator.alpha_es>=30", "plan.stations.0.compensator.alpha_es>59.99"),
    *("plan.stations.0.compensator.kind=inverse|aic", "plan.stations.0.compensator.kind!=none", "plan.seed<100"),
    "mte_mm:1<0.5;plan.stations.0.compensator.alpha_es>=30;tag=calibration",
)


def rows(count: int, source: random.Random) -> Iterator[tuple[dict[str, Any], dict[str, Any], list[dict[str, Any]]]]:
    """Runs with their plans and stations, in the order of their numbers."""
    plans = [(name, templates.template(name).as_dict()) for name in templates.names()]
    digests = {name: read_plan(plan).digest for name, plan in plans}
    for number in range(1, count + 1):
        template, plan = source.choice(plans)
        plan = {**plan, "seed": source.randrange(10**6), "stations": [dict(one) for one in plan["stations"]]}
        for station in plan["stations"]:
            station["compensator"] = {**station["compensator"]}
            if "alpha_es" in station["compensator"]:
                station["compensator"]["alpha_es"] = round(source.uniform(1, 60), 2)
        if "scale" in plan["motion"]:
            plan["motion"] = {**plan["motion"], "scale": {"kind": "factor", "factor": round(source.uniform(0.1, 2), 3)}}
        state = source.choice(STATES)
        submitted = FIRST + timedelta(minutes=9 * number)
        elapsed = source.lognormvariate(1, 1)
        run = {
            "number": number,
            "id": str(uuid.UUID(int=source.getrandbits(128))),
            "name": f"{plan['name']}, variant {source.randrange(500)}",
            "state": state,
            "submitted_by": source.choice(PEOPLE),
            "submitted_at": submitted,
            "started_at": submitted + timedelta(minutes=1),
            "finished_at": submitted + timedelta(minutes=1, seconds=elapsed),
            "attempt": 1,
            "worker": "laboratory-1",
            "doing": "",
            "share": 1.0,
            "reason": "The test ran to its end."
            if state == "completed"
            else f"Station {source.choice((1, 2))}: velocity limit",
            "template": template,
            "test": plan["test"],
            "tags": source.sample(TAGS, source.choice((0, 0, 0, 1, 2))),
            "notes": f"Damper {source.randrange(10**4)}: checked before the test." if source.random() < 0.1 else "",
            "archived": source.random() < 0.05,
            "digest": digests[template],
            "code_version": "0.2.0",
            "seed": plan["seed"],
            "duration_s": 40.0,
            "simulated_s": 40.0,
            "elapsed_s": elapsed,
            "input_energy_kNm": source.lognormvariate(4, 1),
            "floors_peak_mm": [source.lognormvariate(3, 0.5) for _ in range(2)],
            "recording_sha256": "0" * 64,
            "recording_size": source.randrange(10**5, 10**7),
        }
        stations = [
            {
                "run_number": number,
                "number": index,
                "name": station["name"],
                **{one.key: source.lognormvariate(0, 1.5) for one in of(StationMeasure)},
            }
            for index, station in enumerate(plan["stations"], start=1)
        ]
        yield run, plan, stations


def fill(url: str, count: int) -> None:
    """Write `count` runs into the database at `url`."""
    db.migrate(url)
    queue.migrate(url)
    engine = db.connect(url)
    made = rows(count, random.Random(1))
    for first in range(0, count, BATCH):
        part = [next(made) for _ in range(min(BATCH, count - first))]
        found: list[values.Row] = []
        for run, plan, stations in part:
            shown = Run(**{**run, "plan": plan, "stations": [RunStation(**one) for one in stations]})
            found += [(run["number"], path, value) for path, value in values.plan_values(plan)]
            found += [(run["number"], path, value) for one in shown.stations for path, value in values.station_values(one)]
            found += [(run["number"], path, value) for path, value in values.largest_values(shown)]
        with engine.begin() as connection:
            connection.execute(sa.insert(Run), [run for run, _, _ in part])
            connection.execute(sa.insert(RunPlan), [{"run_number": run["number"], "plan": plan} for run, plan, _ in part])
            connection.execute(sa.insert(RunStation), [one for _, _, stations in part for one in stations])
            values.write(connection, found)
        print(f"\r{first + len(part)} runs", end="", flush=True)
    print()
    if engine.dialect.name == "postgresql":  # as autovacuum does on a server within minutes
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            connection.execute(sa.text("VACUUM ANALYZE"))
    engine.dispose()


def is_filled(url: str) -> bool:
    """Whether the database has runs."""
    engine = db.connect(url)
    with engine.connect() as connection:
        found = sa.inspect(connection).has_table("run") and connection.scalar(sa.select(sa.exists(sa.select(Run.number))))
    engine.dispose()
    return bool(found)


def measured(client: TestClient, path: str, query: dict[str, Any]) -> tuple[list[float], int]:
    """Times (ms) of a request, and the largest size (bytes) of its answers."""
    times, size = [], 0
    for _ in range(REPEATS):
        begin = CLOCK()
        answer = client.get(path, params=query)
        times.append(1e3 * (CLOCK() - begin))
        assert answer.status_code == 200, answer.text
        size = max(size, len(answer.content))
    return sorted(times), size


def at(times: list[float], share: float) -> float:
    """The time below which a share of the sorted times lies."""
    return times[min(len(times) - 1, round(share * (len(times) - 1)))]


def report(label: str, times: list[float], size: int) -> None:
    """Print one line."""
    print(f"{label:80s} p50 {at(times, 0.5):7.1f} ms  p95 {at(times, 0.95):7.1f} ms  {size / 1e3:6.1f} kB")


def main() -> None:
    """Fill a database and print the times."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--runs", type=int, default=100_000)
    given.add_argument("--url", default="", help="a PostgreSQL database; default: SQLite in a temporary folder")
    given.add_argument("--data", type=Path, help="a data folder that is kept and used again")
    given.add_argument("--only", metavar="COLUMN", action="append", help="a column to sort by; may be repeated")
    given.add_argument("--cpu", action="store_true", help="print processor time of this process, on a machine that others use")
    asked = given.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        settings = Settings(
            data=asked.data or Path(temporary), database_url=asked.url, embedded_worker=False, local_sign_in=True
        )
        url = settings.prepared().url
        if not is_filled(url):
            begin = time.perf_counter()
            fill(url, asked.runs)
            print(f"filled in {time.perf_counter() - begin:.0f} s")
        with TestClient(create_app(settings), "http://127.0.0.1:8000", client=("127.0.0.1", 50_000)) as client:
            spare_the_collector()  # as `rths serve` does
            client.get("/api/v1/runs/table").raise_for_status()  # the first request of a process imports and connects
            everything = pages(client, asked.only or SORTS)
            if not asked.only:
                everything += filters(client)
            report("all of these", sorted(everything), 0)


def pages(client: TestClient, sorts: Sequence[str]) -> list[float]:
    """Measure pages near and far down, and print the slowest of each order. Returns all times."""
    everything: list[float] = []
    for sort in sorts:
        for order in ("desc", "asc"):
            found = []
            for offset, limit in PAGES:
                query = {"sort": sort, "order": order, "limit": limit, "offset": offset}
                found.append((*measured(client, "/api/v1/runs/table", query), offset))
                everything += found[-1][0]
            times, size, offset = max(found, key=lambda page: at(page[0], 0.95))
            report(f"sort {sort} {order}: slowest page, from row {offset}", times, size)
    report("all sorts and pages", sorted(everything), 0)
    return everything


def filters(client: TestClient) -> list[float]:
    """Measure the first page of filters, searches and lists, and print them. Returns the times of filters."""
    everything: list[float] = []
    for where in FILTERS:
        for sort in ("number", "mte_mm:1", "plan.stations.0.compensator.alpha_es", "elapsed_s"):
            times, size = measured(client, "/api/v1/runs/table", {"where": where, "sort": sort, "limit": PAGE})
            report(f"where {where or '(all)'} sort {sort}", times, size)
            everything += times
    for text in ("variant 17", "#777", "no such run"):
        report(f"search {text}", *measured(client, "/api/v1/runs/table", {"q": text, "limit": PAGE}))
    report("GET /runs limit 500", *measured(client, "/api/v1/runs", {"limit": 500}))
    report("GET /runs sort elapsed_s", *measured(client, "/api/v1/runs", {"sort": "elapsed_s"}))
    report("GET /runs sort mte_mm:1", *measured(client, "/api/v1/runs", {"sort": "mte_mm:1"}))
    report("GET /runs/columns", *measured(client, "/api/v1/runs/columns", {}))
    return everything


if __name__ == "__main__":
    main()
