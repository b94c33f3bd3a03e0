"""REST endpoints of measured recordings."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, File, Query, UploadFile
from fastapi.responses import FileResponse, PlainTextResponse, Response

from app.access import Role, allowed
from app.calculations.answer import Calculated
from app.measured import shown
from app.measured.calculation import LARGE_READING
from app.measured.dependency import Recordings
from app.measured.schemas import EarlierMapping, Import, Preview, RecordingDetail, RecordingList, RecordingOut, Uploaded
from app.openapi import file, told

router = APIRouter(prefix="/api/v1/recordings", tags=["recordings"])
Seconds = Annotated[float | None, Query(allow_inf_nan=False)]


@router.post("/files", status_code=201, responses=told(503))
@allowed(Role.ENGINEER)
def upload(recordings: Recordings, file: Annotated[UploadFile, File()]) -> Uploaded:
    """Upload a file of measurements; the response proposes a mapping.

    The same content is stored once, under its SHA-256. A file from which nothing is imported is deleted after one day.
    """
    return recordings.upload(file.file, file.filename or "")


@router.get("/files/{sha256}", response_model=Uploaded, responses=told(404, 409, 422, 503))
@allowed(Role.VIEWER)
def uploaded(sha256: str, recordings: Recordings) -> Response:
    """An uploaded file, with its columns and the proposed mapping."""
    return Calculated(recordings.bound(sha256), recordings.uploaded, sha256)


@router.get("/roles")
@allowed(Role.VIEWER)
def roles() -> dict[str, Any]:
    """The roles that a column can have, with the units of each role."""
    return shown.roles()


@router.get("/mappings")
@allowed(Role.VIEWER)
def mappings(recordings: Recordings) -> dict[str, list[EarlierMapping]]:
    """List the mappings of earlier imports, each once, newest first."""
    return {"mappings": recordings.mappings()}


@router.post("/preview", response_model=dict[str, Any], responses=told(404, 503))
@allowed(Role.ENGINEER)
def preview(asked: Annotated[Preview, Body()], recordings: Recordings) -> Response:
    """Read an uploaded file by a mapping: decimated channels, the findings of the checks, and lags. Nothing is stored.

    With `from_s` and `to_s`, the channels show that part of the time, and lags are not computed.
    """
    return Calculated(recordings.bound(asked.file), recordings.preview, asked)


@router.post("", status_code=201, responses=told(404, 503))
@allowed(Role.ENGINEER)
def add(asked: Annotated[Import, Body()], recordings: Recordings) -> RecordingDetail:
    """Import an uploaded file by a mapping. The mapping is JSON, or YAML as a string."""
    return RecordingDetail.model_validate(recordings.import_(asked))


@router.get("")
@allowed(Role.VIEWER)
def listed(
    recordings: Recordings,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> RecordingList:
    """List recordings, newest first."""
    found, total = recordings.listed(limit, offset)
    return RecordingList(recordings=[RecordingOut.model_validate(one) for one in found], total=total)


@router.get("/{recording_id}")
@allowed(Role.VIEWER)
def one(recording_id: str, recordings: Recordings) -> RecordingDetail:
    """A recording with its channels and its mapping."""
    return RecordingDetail.model_validate(recordings.get(recording_id))


@router.get("/{recording_id}/preview", response_model=dict[str, Any], responses=told(409, 503))
@allowed(Role.VIEWER)
def channels(recording_id: str, recordings: Recordings, from_s: Seconds = None, to_s: Seconds = None) -> Response:
    """The channels of a recording in the units shown: all of its time, or a part of it, decimated to its extremes."""
    return Calculated(LARGE_READING, recordings.channels, recording_id, shown.Part(from_s, to_s))


@router.get("/{recording_id}/recording.h5", response_class=FileResponse, responses=file("application/x-hdf5") | told(409))
@allowed(Role.VIEWER)
def hdf5(recording_id: str, recordings: Recordings) -> FileResponse:
    """A recording as HDF5, in SI units."""
    return FileResponse(recordings.hdf5(recording_id), media_type="application/x-hdf5", filename=f"{recording_id}.h5")


@router.get("/{recording_id}/raw", response_class=FileResponse, responses=file("application/octet-stream") | told(409))
@allowed(Role.VIEWER)
def raw(recording_id: str, recordings: Recordings) -> FileResponse:
    """The uploaded file from which a recording was imported, unchanged."""
    path, filename = recordings.raw(recording_id)
    return FileResponse(path, media_type="application/octet-stream", filename=filename)


@router.get("/{recording_id}/mapping.yaml", response_class=Response, responses=file("application/yaml"))
@allowed(Role.VIEWER)
def mapping(recording_id: str, recordings: Recordings) -> PlainTextResponse:
    """The mapping of a recording as YAML, for files of the same layout."""
    headers = {"Content-Disposition": f'attachment; filename="{recording_id}.yaml"'}
    return PlainTextResponse(recordings.mapping_text(recording_id), media_type="application/yaml", headers=headers)


@router.delete("/{recording_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(recording_id: str, recordings: Recordings) -> None:
    """Delete a recording that nothing refers to. Its uploaded file is deleted too if no other recording needs it."""
    recordings.remove(recording_id)
