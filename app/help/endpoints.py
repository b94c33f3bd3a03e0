"""REST endpoint of the glossary."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from app.access import Role, allowed
from rths_engine.results.glossary import glossary

router = APIRouter(prefix="/api/v1", tags=["plans"])


class TermOut(BaseModel):
    """A term, its symbol, its unit as people read it (both may be empty), and what it means."""

    term: str
    symbol: str
    unit: str
    meaning: str


class GlossaryOut(BaseModel):
    """All terms in alphabetical order."""

    terms: list[TermOut]


@router.get("/glossary")
@allowed(Role.VIEWER)
def terms() -> GlossaryOut:
    """Terms, symbols, measures and channels with their units and meanings."""
    return GlossaryOut(terms=[TermOut(**one._asdict()) for one in glossary()])
