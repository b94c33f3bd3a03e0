"""REST endpoints of annotations."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import Response

from app.access import Role, allowed
from app.annotations.dependency import Annotations
from app.annotations.schemas import AnnotationList, AnnotationOut, Written

router = APIRouter(prefix="/api/v1/runs/{run_id}/annotations", tags=["annotations"])


@router.get("")
@allowed(Role.VIEWER)
def listed(run_id: str, annotations: Annotations) -> AnnotationList:
    """List the annotations of a run in order of time. The numbers are those of the marks on its charts."""
    return annotations.listed(run_id)


@router.post("", status_code=201)
@allowed(Role.ENGINEER)
def add(run_id: str, annotations: Annotations, written: Annotated[Written, Body()]) -> AnnotationOut:
    """Write an annotation at a time of a run, or over a span, on one station or on the whole test."""
    return annotations.add(run_id, written)


@router.put("/{annotation_id}")
@allowed(Role.ENGINEER)
def edit(run_id: str, annotation_id: str, annotations: Annotations, written: Annotated[Written, Body()]) -> AnnotationOut:
    """Replace an annotation."""
    return annotations.edit(run_id, annotation_id, written)


@router.delete("/{annotation_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(run_id: str, annotation_id: str, annotations: Annotations) -> None:
    """Delete an annotation."""
    annotations.remove(run_id, annotation_id)
