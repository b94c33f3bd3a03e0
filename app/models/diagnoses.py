"""Tables of diagnoses and of the recordings that they read."""

from __future__ import annotations

from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column, relationship

from app.db import Base
from app.jobs.tables import Job


class Diagnosis(Job, Base):
    """A diagnosis: a job that compares a recording with the models of a plan, and its result after it has completed."""

    __tablename__ = "diagnosis"

    name: Mapped[str] = mapped_column(sa.String(200))
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    level: Mapped[float]
    code_version: Mapped[str] = mapped_column(sa.String(40))
    found: Mapped[str | None] = mapped_column(sa.String(24))
    sentence: Mapped[str | None] = mapped_column(sa.Text)
    verdict: Mapped[dict[str, Any] | None] = mapped_column(sa.JSON(none_as_null=True), deferred=True)
    pictures: Mapped[dict[str, Any] | None] = mapped_column(sa.JSON(none_as_null=True), deferred=True)
    before_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))
    after_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))
    inputs: Mapped[list[DiagnosisInput]] = relationship(
        order_by="DiagnosisInput.place", cascade="all, delete-orphan", lazy="selectin"
    )

    @property
    def recording(self) -> DiagnosisInput:
        return self.inputs[0]

    @property
    def heldout(self) -> list[DiagnosisInput]:
        return self.inputs[1:]


class DiagnosisInput(Base):
    """A recording that a diagnosis reads, imported or from a run. The first is fitted, the others are held out."""

    __tablename__ = "diagnosis_input"

    diagnosis_number: Mapped[int] = mapped_column(sa.ForeignKey("diagnosis.number", ondelete="CASCADE"), primary_key=True)
    place: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    recording_id: Mapped[str | None] = mapped_column(sa.ForeignKey("measured_recording.id"), index=True)
    run_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))
