"""REST endpoints of saved mappings."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import PlainTextResponse, Response

from app.access import Role, allowed
from app.measured.dependency import Recordings
from app.measured.schemas import NewMapping, NewName, SavedMappingList, SavedMappingOut
from app.openapi import file, told

router = APIRouter(prefix="/api/v1/mappings", tags=["saved mappings"])


@router.get("")
@allowed(Role.VIEWER)
def listed(recordings: Recordings) -> SavedMappingList:
    """List the saved mappings, newest first."""
    return SavedMappingList(mappings=[SavedMappingOut.model_validate(one) for one in recordings.saved.listed()])


@router.post("", status_code=201, responses=told(404, 503))
@allowed(Role.ENGINEER)
def save(asked: Annotated[NewMapping, Body()], recordings: Recordings) -> SavedMappingOut:
    """Save a mapping under a name. It is proposed again for every file with the layout of `file`.

    A layout is the format, and the names and units of the columns in their order.
    """
    return SavedMappingOut.model_validate(recordings.save_mapping(asked))


@router.get("/{mapping_id}")
@allowed(Role.VIEWER)
def one(mapping_id: str, recordings: Recordings) -> SavedMappingOut:
    """A saved mapping with its layout."""
    return SavedMappingOut.model_validate(recordings.saved.get(mapping_id))


@router.get("/{mapping_id}/mapping.yaml", response_class=Response, responses=file("application/yaml"))
@allowed(Role.VIEWER)
def text(mapping_id: str, recordings: Recordings) -> PlainTextResponse:
    """A saved mapping as YAML, for the command line."""
    headers = {"Content-Disposition": f'attachment; filename="{mapping_id}.yaml"'}
    return PlainTextResponse(recordings.saved.text(mapping_id), media_type="application/yaml", headers=headers)


@router.patch("/{mapping_id}")
@allowed(Role.ENGINEER)
def rename(mapping_id: str, asked: Annotated[NewName, Body()], recordings: Recordings) -> SavedMappingOut:
    """Rename a saved mapping."""
    return SavedMappingOut.model_validate(recordings.saved.rename(mapping_id, asked.name))


@router.delete("/{mapping_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(mapping_id: str, recordings: Recordings) -> None:
    """Delete a saved mapping. Recordings that were imported by it stay as they are."""
    recordings.saved.remove(mapping_id)
