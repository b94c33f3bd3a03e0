"""SQL of approvals. Never commits."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import now
from app.models import Approval


class ApprovalRepository:
    """SQL of approvals. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def waiting(self) -> list[Approval]:
        """The approvals that nobody has decided, oldest first."""
        return list(self.session.scalars(sa.select(Approval).where(Approval.decision.is_(None)).order_by(Approval.number)))

    def decide(self, approval: Approval, decision: str, by: str, reason: str = "") -> None:
        approval.decision, approval.decided_by, approval.decided_at = decision, by, now(self.session)
        approval.reason = reason
