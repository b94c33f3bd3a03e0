"""The files of each entity, made from a run: model, controller, outputs, measures and reports."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.measures import rows as measured
from rths_engine.planning import plan_yaml
from rths_engine.planning.model import Model
from rths_engine.recordings.run_file import Recording
from rths_engine.results.channels import CHANNELS, Channel

Content = bytes | Path
COORDINATOR = ("ag", "force_ext", "x_cmd", "x_comp", "error", "ti", "d_alpha", "energy_error")
SIMULATED, MEASURED = ("x_floor",), ("x_meas", "f_meas", "current")


@dataclass(frozen=True, slots=True)
class Entity:
    """An entity made from a run: its kind, its number among equals (0: the only one), title, description and files."""

    kind: str
    number: int
    title: str
    description: str
    files: Mapping[str, Content]


def entities(run: Mapping[str, Any], recording: Recording, path: Path, reports: Mapping[str, bytes]) -> Iterator[Entity]:
    """The entities of a hybrid simulation. `path` is the recording's file, `reports` are the report's files by name."""
    plan, version = recording.plan, str(recording.attrs.get("code_version", ""))
    whole = f"of the real-time hybrid simulation {plan.name!r} (plan digest {plan.digest[:12]})"
    emulated = "" if run.get("rig_kind") == "physical" else " The laboratory is emulated: actuators and specimens are models."
    yield Entity(
        "global_model", 0, "Structure, loading and rig",
        f"Complete test plan {whole}: structure, ground motion, integrator, stations and limits, in SI units.{emulated}",
        {"plan.yaml": plan_yaml.write(plan).encode(), "ground_motion.csv": table(recording, ("ag", "force_ext"))},
    )  # fmt: skip
    yield Entity(
        "coordinator", 0, "Integration and compensation",
        f"Settings of the coordinator {whole}: integration algorithm, controller rate and delay compensators.",
        {"coordinator.json": _json(_coordinator(recording, version))},
    )  # fmt: skip
    yield Entity(
        "coordinator_output", 0, "Commands and tracking",
        f"Commands, compensated commands and tracking {whole}, at every controller step; the HDF5 file holds all channels.",
        {"coordinator_output.csv": table(recording, COORDINATOR), "recording.h5": path},
    )  # fmt: skip
    yield Entity(
        "sim_substructure", 0, "Computed structure",
        f"Computed substructure {whole}: its parameters, and its mass, damping and stiffness matrices in SI units.",
        _structure(recording),
    )  # fmt: skip
    yield Entity(
        "sim_output", 0, "Floor displacements",
        f"Displacements of the floors relative to the ground {whole}, at every controller step.",
        {"simulation_output.csv": table(recording, SIMULATED)},
    )  # fmt: skip
    for number, station in enumerate(plan.stations, start=1):
        own = f"of station {number} ({station.name})"
        yield Entity(
            "exp_substructure", number, f"Station {number}, {station.name}",
            f"Actuator, specimen, sensors and safety limits {own} {whole}.{emulated}",
            {f"station_{number}.json": _json(station.model_dump(mode="json"))},
        )  # fmt: skip
        yield Entity(
            "exp_output", number, f"Measurements of station {number}",
            f"Measured displacement and force {own} {whole}, at every controller step.",
            {f"experimental_output_{number}.csv": table(recording, MEASURED, number)},
        )  # fmt: skip
    yield Entity(
        "analysis", 0, "Measures",
        f"Measures of tracking, energy and response {whole}, each with its unit and definition.",
        {"measures.csv": _measures(recording)},
    )  # fmt: skip
    yield Entity(
        "report", 0, "Test report and data dictionary",
        f"Report {whole} with figures, test record and plan, and the meaning and unit of every column.",
        {**reports, "data_dictionary.csv": _dictionary(recording.channels)},
    )  # fmt: skip


def table(recording: Recording, roles: Sequence[str], station: int | None = None) -> bytes:
    """The channels of these roles as CSV in the units shown, time first; with `station`, only those of this station."""
    kept = [
        (number, one)
        for number, one in enumerate(recording.channels)
        if one.role in roles and (station is None or one.number == station)
    ]
    columns = [recording.time, *(recording.signals[:, number] / one.factor for number, one in kept)]
    text = io.BytesIO()
    heading = ",".join(["t (s)", *(one.heading for _, one in kept)])
    np.savetxt(text, np.column_stack(columns), fmt="%.9g", delimiter=",", newline="\r\n", header=heading, comments="")
    return text.getvalue()


def _coordinator(recording: Recording, version: str) -> dict[str, Any]:
    plan = recording.plan
    return {
        "application": "RTHS control room",
        "applicationVersion": version,
        "controller_rate_Hz": plan.controller_rate,
        "integrator": plan.integrator.model_dump(mode="json"),
        "compensators": [one.compensator.model_dump(mode="json") for one in plan.stations],
        "plan_digest_sha256": plan.digest,
    }


def _structure(recording: Recording) -> dict[str, Content]:
    model = Model(recording.plan)
    built = model.built
    matrices = {"mass_kg": built.mass, "damping_Ns_per_m": built.damping, "stiffness_N_per_m": built.stiffness}
    found: dict[str, Content] = {"structure.json": _json(recording.plan.structure.model_dump(mode="json"))}
    for name, values in matrices.items():
        text = io.BytesIO()
        np.savetxt(text, np.atleast_2d(values), fmt="%.9g", delimiter=",", newline="\r\n")
        found[f"{name}.csv"] = text.getvalue()
    return found


def _measures(recording: Recording) -> bytes:
    rows = (
        [where, one.key, one.label, "" if value is None else f"{value:.9g}", one.shown, one.meaning]
        for where, one, value in measured(recording.summary, recording.plan.test)
    )
    return _csv(["station or floor", "key", "measure", "value", "unit", "meaning"], rows)


def _dictionary(channels: Sequence[Channel]) -> bytes:
    rows = ([one.heading, one.label, CHANNELS[one.role].symbol, one.shown, CHANNELS[one.role].meaning] for one in channels)
    return _csv(["column", "label", "symbol", "unit", "meaning"], [["t (s)", "Time", "t", "s", "time of each sample"], *rows])


def _csv(heading: Sequence[str], rows: Any) -> bytes:
    text = io.StringIO()
    csv.writer(text).writerows([heading, *rows])
    return text.getvalue().encode()


def _json(data: Any) -> bytes:
    return json.dumps(data, indent=2, ensure_ascii=False).encode()
