"""A recording as a MATLAB file (version 5), with names that MATLAB accepts.

`t` (s) and one variable for each channel: `x_cmd_1` is a struct with `values` (samples x 1, SI), `unit`, `label`, `symbol` and
`station` or `floor`. `test` is a struct with name, digest, status, step and plan; `measures` has a struct for each measure of
each station, with value and unit. SciPy writes any name and any size; MATLAB loads names of letters, digits and underscores, in
fields at most 31 of them, and variables below 2 GB (findings/scipy_savemat_names.sh).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import savemat

from app.measures import rows
from app.problems import Conflict
from rths_engine.recordings.run_file import Recording
from rths_engine.results.channels import CHANNELS, Channel

LONGEST = 31  # characters of a name: those of a field, so that every name may also be a field
LARGEST = 2**31  # bytes of a variable that MATLAB loads from a file of version 5
KEYWORDS = frozenset(
    {"break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global", "if"}
    | {"otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"}
)


def write(path: Path, run: Mapping[str, Any], recording: Recording) -> None:
    """Write a recording as a MATLAB file. Raises Conflict for a channel that MATLAB could not load."""
    if 8 * len(recording.signals) >= LARGEST:
        raise Conflict("A channel of this recording is 2 GB or larger, which a MATLAB file cannot hold. Download it as HDF5.")
    content: dict[str, Any] = {"t": recording.time[:, None]}
    for number, channel in enumerate(recording.channels):
        content[name(channel.key)] = _channel(channel, recording.signals[:, number])
    content["test"] = _test(run, recording)
    content["measures"] = _measures(recording)
    savemat(path, content, format="5", do_compression=True, oned_as="column")


def name(key: str) -> str:
    """A name that MATLAB accepts: `x_cmd.1` becomes `x_cmd_1`."""
    plain = re.sub(r"\W", "_", key, flags=re.ASCII)
    if not re.match(r"[A-Za-z]", plain) or plain in KEYWORDS:
        plain = f"v_{plain.lstrip('_')}"
    return plain[:LONGEST]


def _channel(channel: Channel, values: Any) -> dict[str, Any]:
    role = CHANNELS[channel.role]
    about = {"values": np.ascontiguousarray(values)[:, None], "unit": role.unit, "label": channel.label, "symbol": role.symbol}
    return about if channel.number is None else {**about, role.counts: float(channel.number)}


def _test(run: Mapping[str, Any], recording: Recording) -> dict[str, Any]:
    plan = recording.plan
    return {
        "name": str(run.get("name") or plan.name),
        "run": str(run.get("id") or ""),
        "status": recording.status,
        "digest": plan.digest,
        "engine_version": str(recording.attrs.get("code_version", "")),
        "step": recording.dt,
        "step_unit": "s",
        "plan_json": json.dumps(plan.as_dict()),
    }


def _measures(recording: Recording) -> dict[str, Any]:
    """`measures.station_1.mte_mm`: value and unit; NaN where a measure has no value."""
    found: dict[str, dict[str, Any]] = {}
    for where, one, value in rows(_numbered(recording), recording.plan.test):
        place = name(where.lower().replace(" ", "_"))
        known = float("nan") if value is None else float(value)
        found.setdefault(place, {})[name(one.key)] = {"value": known, "unit": one.shown, "label": one.label}
    return found


def _numbered(recording: Recording) -> dict[str, Any]:
    """The summary with numbers for the names of stations, which may be equal."""
    stations = [{**one, "name": f"station {number}"} for number, one in enumerate(recording.summary["stations"], start=1)]
    return {**recording.summary, "stations": stations}
