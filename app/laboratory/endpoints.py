"""REST endpoints of the laboratory's identity."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, File, UploadFile
from fastapi.responses import Response

from app import headers
from app.access import Role, allowed
from app.laboratory.dependency import OneLaboratory
from app.laboratory.logo import PNG, SVG
from app.laboratory.schemas import IdentityIn, LaboratoryOut
from app.openapi import told
from app.problems import NotFound

router = APIRouter(prefix="/api/v1/laboratory", tags=["laboratory"])
ONLY_AN_IMAGE = {headers.POLICY: headers.PICTURE, "Cache-Control": "no-cache"}


@router.get("", responses=told(422))
@allowed(Role.VIEWER)
def shown(laboratory: OneLaboratory) -> LaboratoryOut:
    """Name, address, signatures and logo of the laboratory, as reports show them."""
    return laboratory.shown()


@router.put("")
@allowed(Role.ADMINISTRATOR)
def save(laboratory: OneLaboratory, identity: Annotated[IdentityIn, Body()]) -> LaboratoryOut:
    """Set name, address and signatures of the laboratory."""
    laboratory.save(identity)
    return laboratory.shown()


@router.get(
    "/logo",
    response_class=Response,
    responses=told(404, 422) | {200: {"description": "The image", "content": {PNG: {"schema": {}}, SVG: {"schema": {}}}}},
)
@allowed(Role.VIEWER)
def logo(laboratory: OneLaboratory) -> Response:
    """The logo of the laboratory, a PNG or SVG image."""
    image = laboratory.logo
    if image is None:
        raise NotFound("The laboratory has no logo.")
    return Response(image.data, media_type=image.media_type, headers=ONLY_AN_IMAGE)


@router.put("/logo")
@allowed(Role.ADMINISTRATOR)
def save_logo(laboratory: OneLaboratory, file: Annotated[UploadFile, File()]) -> LaboratoryOut:
    """Set the logo of the laboratory: a PNG or SVG image of at most 200 kB."""
    laboratory.save_logo(file.file.read())
    return laboratory.shown()


@router.delete("/logo", status_code=204, response_class=Response, responses=told(404, 422))
@allowed(Role.ADMINISTRATOR)
def remove_logo(laboratory: OneLaboratory) -> None:
    """Remove the logo of the laboratory."""
    laboratory.remove_logo()
