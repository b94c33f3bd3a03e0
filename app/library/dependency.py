"""The services of the library in a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.calculations.answer import Calculating
from app.dependencies import Library, OneSession
from app.library.comparison import ComparisonService
from app.library.drafts import DraftService
from app.library.service import LibraryService


def library_service(session: OneSession, motions: Library, calculate: Calculating) -> LibraryService:
    """The service of plans in the library."""
    return LibraryService(session, motions, calculate)


def draft_service(session: OneSession, motions: Library) -> DraftService:
    """The service of drafts."""
    return DraftService(session, motions)


def comparison_service(session: OneSession) -> ComparisonService:
    """The service of differences between plans."""
    return ComparisonService(session)


KeptPlans = Annotated[LibraryService, Depends(library_service)]
Drafts = Annotated[DraftService, Depends(draft_service)]
Comparisons = Annotated[ComparisonService, Depends(comparison_service)]
