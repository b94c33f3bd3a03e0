"""Open a recording, measured or of a run, as measurements."""

from __future__ import annotations

from pathlib import Path

import h5py

from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.recordings import damage, run_file
from rths_engine.recordings.measured import store
from rths_engine.recordings.measured.recording import Measured
from rths_engine.recordings.of_run import of_run


def load(path: Path) -> Measured:
    """The recording in `path`. Raises RecordingError where the file is missing, damaged or not a recording."""
    schema = _schema(path)
    if schema == store.SCHEMA:
        return store.load(path)
    if schema in run_file.SCHEMAS:
        return of_run(run_file.load(path), path.name)
    problem = f"{path.name} is not a recording: its schema is {schema!r}, not {store.SCHEMA} or {run_file.SCHEMA}"
    raise RecordingError(Issue("", problem, fix="import the measurements, or run the plan again"))


def _schema(path: Path) -> str:
    try:
        with h5py.File(path, "r") as file:
            schema = file.attrs.get("schema")
            return schema if isinstance(schema, str) else repr(schema)
    except FileNotFoundError:
        raise RecordingError(Issue("", f"the recording {path.name} does not exist")) from None
    except damage.KINDS as error:
        fix = "import the measurements again, or run the plan again"
        raise RecordingError(Issue("", f"{path.name} is not a complete recording: {error}", fix=fix)) from None
