"""REST endpoints of the library of ground motions."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, File, Form, UploadFile
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated, Calculating
from app.calculations.bound import Bound
from app.motions.dependency import Motions
from app.motions.schemas import MotionFile
from app.motions.service import MotionService, preview
from app.openapi import told

router = APIRouter(prefix="/api/v1/motions", tags=["ground motions"])
RECORD = Bound("reading of the record", seconds=20, megabytes=2000, mend="shorten the record", where="file")
Text = Annotated[str, Form(max_length=200)]


@router.get("")
@allowed(Role.VIEWER)
def listed(motions: Motions) -> dict[str, Any]:
    """List the ground motions with PGA, time step and duration."""
    return {"motions": motions.listed()}


@router.post("", status_code=201, responses=told(503))
@allowed(Role.ENGINEER)
def upload(
    motions: Motions,
    calculate: Calculating,
    file: Annotated[UploadFile, File()],
    unit: Text = "",
    dt: Text = "",
    channel: Text = "",
    name: Text = "",
) -> dict[str, Any]:
    """Add a ground motion from a file of a known format. Give `unit` and `dt` (s) if the file does not state them.

    `channel` is the name or the number of an acceleration channel, if the file has several.
    """
    return motions.add(calculate(RECORD, motions.read, file.file.read(), file.filename or "", unit, dt, channel, name))


@router.post("/contents", response_model=MotionFile, responses=told(503))
@allowed(Role.VIEWER)
def contents(motions: Motions, file: Annotated[UploadFile, File()]) -> Response:
    """What stands in a file: its acceleration channels, its header, and what the header states beside what was read.

    `asks` lists what the file does not state. Nothing is stored.
    """
    return Calculated(RECORD, motions.contents, file.file.read(), file.filename or "")


@router.post("/preview", response_model=dict[str, Any], responses=told(503))
@allowed(Role.VIEWER)
def look(
    motions: Motions,
    file: Annotated[UploadFile, File()],
    unit: Text = "",
    dt: Text = "",
    channel: Text = "",
    name: Text = "",
) -> Response:
    """Read a ground motion and return its samples and response spectrum. Nothing is stored."""
    return Calculated(RECORD, _looked_at, motions, file.file.read(), file.filename or "", unit, dt, channel, name)


@router.get("/{name}")
@allowed(Role.VIEWER)
def one(name: str, motions: Motions) -> dict[str, Any]:
    """A ground motion with PGA, time step, duration and provenance."""
    return motions.summary(name)


@router.get("/{name}/preview", response_model=dict[str, Any], responses=told(422, 503))
@allowed(Role.VIEWER)
def shown(name: str, motions: Motions) -> Response:
    """Samples and response spectrum of a ground motion, for plots."""
    return Calculated(RECORD, motions.preview, name)


@router.delete("/{name}", status_code=204, response_class=Response, responses=told(422))
@allowed(Role.ENGINEER)
def remove(name: str, motions: Motions) -> None:
    """Delete a ground motion that was uploaded. Bundled ground motions cannot be deleted."""
    motions.remove(name)


def _looked_at(motions: MotionService, *file: Any) -> dict[str, Any]:
    return preview(motions.read(*file))
