"""The JSON forms of a diagnosis, `rths-diagnosis/1` and `rths-diagnosis-pictures/1`. They import no code that diagnoses."""

from rths_engine.diagnosis.schema.certificate import Certificate, Rate
from rths_engine.diagnosis.schema.components import ComponentVerdict, Kind, Where
from rths_engine.diagnosis.schema.effects import Candidate, NamedEffect, NextTest, Parameter, RejectedEffect
from rths_engine.diagnosis.schema.fit import Errors, Fit
from rths_engine.diagnosis.schema.form import Form
from rths_engine.diagnosis.schema.pictures import Pictures
from rths_engine.diagnosis.schema.unexplained import LawTerm, Scale, Unexplained
from rths_engine.diagnosis.schema.verdict import Verdict

__all__ = [
    "Candidate",
    "Certificate",
    "ComponentVerdict",
    "Errors",
    "Fit",
    "Form",
    "Kind",
    "LawTerm",
    "NamedEffect",
    "NextTest",
    "Parameter",
    "Pictures",
    "Rate",
    "RejectedEffect",
    "Scale",
    "Unexplained",
    "Verdict",
    "Where",
]
