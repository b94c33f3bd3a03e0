"""Tables of the service. Times are UTC; the name of a number ends with its unit."""

from app.audit.tables import AuditEntry, AuditHead
from app.events.tables import Event
from app.leases import Lease
from app.models.accounts import Account, AccountLink, AccountSession, ApiToken
from app.models.control import Approval, RigControl, Rules
from app.models.diagnoses import Diagnosis, DiagnosisInput
from app.models.library import LibraryPlan, PlanDraft, PlanTag, PlanVersion
from app.models.measured import ImportBatch, MeasuredRecording, RawFile, SavedMapping
from app.models.operation import WorkerMetrics
from app.models.runs import (
    EMULATED,
    LONG_TEXTS,
    LONGEST_VALUE,
    SHORT,
    SORTED,
    Annotation,
    Rig,
    Run,
    RunPlan,
    RunStation,
    RunValue,
    RunView,
    ValuePath,
    is_long,
    is_short,
)
from app.models.sweeps import Sweep, SweepPart, SweepShard

__all__ = [
    "EMULATED",
    "LONGEST_VALUE",
    "LONG_TEXTS",
    "SHORT",
    "SORTED",
    "Account",
    "AccountLink",
    "AccountSession",
    "Annotation",
    "ApiToken",
    "Approval",
    "AuditEntry",
    "AuditHead",
    "Diagnosis",
    "DiagnosisInput",
    "Event",
    "ImportBatch",
    "Lease",
    "LibraryPlan",
    "MeasuredRecording",
    "PlanDraft",
    "PlanTag",
    "PlanVersion",
    "RawFile",
    "Rig",
    "RigControl",
    "Rules",
    "Run",
    "RunPlan",
    "RunStation",
    "RunValue",
    "RunView",
    "SavedMapping",
    "Sweep",
    "SweepPart",
    "SweepShard",
    "ValuePath",
    "WorkerMetrics",
    "is_long",
    "is_short",
]
