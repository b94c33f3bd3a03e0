"""The report of a diagnosis: one HTML file that needs no network."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.reports import page
from app.reports.diagnosis_figures import details, over_time
from app.reports.diagnosis_tables import tables
from rths_engine.diagnosis.schema import Pictures, Verdict

Facts = list[tuple[str, str]]


def shown(verdict: Verdict, pictures: Pictures, plan: Mapping[str, Any]) -> dict[str, Any]:
    """The tables and plots that the templates of the page and of the report show; `plan` is the plan in JSON form."""
    return {"told": tables(verdict, plan), "over_time": over_time(pictures), "details": details(pictures)}


def report_html(title: str, facts: Facts, verdict: Verdict, pictures: Pictures, plan: Mapping[str, Any]) -> str:
    """The report of a diagnosis as a stand-alone HTML file."""
    return page.render("diagnosis_report.html", title=title, facts=facts, **shown(verdict, pictures, plan))
