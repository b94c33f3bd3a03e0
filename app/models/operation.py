"""The table through which the metrics of workers reach the web service."""

from __future__ import annotations

from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base


class WorkerMetrics(Base):
    """The metrics of a worker in the text form of Prometheus, written again every few seconds."""

    __tablename__ = "worker_metrics"

    worker: Mapped[str] = mapped_column(sa.String(80), primary_key=True)
    at: Mapped[datetime]
    text: Mapped[str] = mapped_column(sa.Text)
