"""Plans before they are run: templates, schema, checking, YAML."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from app.problems import NotFound
from rths_engine import motion as planned_motion
from rths_engine import templates
from rths_engine.ground_motions import MotionLibrary
from rths_engine.plan import Plan


class PlanService:
    def __init__(self, motions: MotionLibrary):
        self.motions = motions

    def templates(self) -> list[dict[str, str]]:
        return [{"name": name, "title": templates.template(name).name} for name in templates.names()]

    def template(self, name: str) -> dict[str, Any]:
        """The plan of a template, and the paper's row where it is one of Table III."""
        if name not in templates.names():
            raise NotFound(f"There is no template '{name}'; there are {', '.join(templates.names())}.")
        paper = templates.PAPER.get(name)
        return {"name": name, "plan": templates.template(name).as_dict(), "paper": asdict(paper) if paper else None}

    def schema(self) -> dict[str, Any]:
        return Plan.model_json_schema()

    def check(self, data: Any) -> dict[str, Any]:
        """The plan as understood, with its digest and what it amounts to. Raises PlanError or MotionError."""
        plan = Plan.read(data)
        periods = plan.periods()
        unscaled = plan.motion.unscaled(self.motions)
        scaled = planned_motion.scaled(plan.motion, self.motions, float(periods[0]))
        duration = plan.duration or scaled.duration
        summary = {
            "periods_s": periods.tolist(),
            "steps": round(duration / plan.integrator.dt),
            "duration_s": duration,
            "pga": scaled.pga,
            "scale_factor": scaled.pga / unscaled.pga,
        }
        return {"plan": plan.as_dict(), "digest": plan.digest, "warnings": _warnings(plan, scaled.duration), "summary": summary}

    def read(self, text: str) -> dict[str, Any]:
        return Plan.from_yaml(text).as_dict()

    def write(self, data: Any) -> str:
        return Plan.read(data).to_yaml()


def _warnings(plan: Plan, record: float) -> list[str]:
    found = []
    if plan.duration and plan.duration < record:
        found.append(f"The test ends at {plan.duration:g} s, before its record does at {record:g} s.")
    for station in plan.stations:
        if station.limits.force > station.actuator.force_limit:
            found.append(f"{station.name}: the force limit is above the actuator's force capacity and can't trip.")
        if station.limits.velocity > station.actuator.velocity_limit:
            found.append(f"{station.name}: the velocity limit is above what the actuator can reach.")
    return found
