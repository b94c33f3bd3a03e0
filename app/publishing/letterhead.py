"""The head of a report, from the laboratory's identity."""

from __future__ import annotations

from app.laboratory.service import Laboratory
from app.reports.document import Letterhead


def letterhead(laboratory: Laboratory) -> Letterhead:
    """Name, address and logo of the laboratory."""
    identity, logo = laboratory.identity, laboratory.logo
    return Letterhead(identity.name, identity.address, (logo.data, logo.media_type) if logo else None)
