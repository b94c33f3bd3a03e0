"""Plans before they are run: templates, schema, checks and YAML."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from app.checking import Checked, checked
from app.plans.drive import preview
from app.problems import NotFound
from app.text import refuse_unstorable
from rths_engine import stability
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import plan_yaml, templates
from rths_engine.planning.paper import PAPER
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_to_yaml, read_plan
from rths_engine.results.channels import CHANNELS
from rths_engine.results.glossary import glossary
from rths_engine.results.measures import MEASURES

LARGEST_YAML = 1_000_000  # bytes; YAML is read at some 50 kB/s


class PlanService:
    """Rules of plans: check, preview and templates. No HTTP."""

    def __init__(self, motions: MotionLibrary):
        self.motions = motions

    def templates(self) -> list[dict[str, str]]:
        """The templates, each with name, title, the group in which the form lists it, and what it is about."""
        found = [(name, templates.template(name)) for name in templates.names()]
        return [{"name": name, "title": plan.name, "group": templates.group(name), "about": plan.notes} for name, plan in found]

    def template(self, name: str) -> dict[str, Any]:
        """The plan of a template, and the paper's results if the template is a simulation of Table III."""
        if name not in templates.names():
            raise NotFound(f"There is no template '{name}'. Templates: {', '.join(templates.names())}.")
        paper = PAPER.get(name)
        return {"name": name, "plan": templates.template(name).as_dict(), "paper": asdict(paper) if paper else None}

    def schema(self) -> dict[str, Any]:
        """JSON Schema of a plan, with the tables of measures and channels and the glossary."""
        return {
            **Plan.model_json_schema(),
            "measures": [one.as_dict() for one in MEASURES],
            "channels": {name: role.as_dict() for name, role in CHANNELS.items()},
            "glossary": [term._asdict() for term in glossary()],
        }

    def check(self, data: Any) -> dict[str, Any]:
        """The plan with every default, its digest, warnings and summary. Raises PlanError or MotionError."""
        found = checked(data, self.motions)
        plan, shaken = found.plan, found.plan.motion.kind != "none"
        summary = {
            "periods_s": found.model.periods.tolist(),
            "steps": found.steps,
            "duration_s": found.duration_s,
            "pga": found.pga if shaken else None,
            "scale_factor": found.scale_factor if shaken else None,
        }
        return {"plan": plan.as_dict(), "digest": plan.digest, "warnings": _warnings(found), "summary": summary}

    def drive(self, data: Any) -> dict[str, Any]:
        """The displacement of a drive against time, with its peak and largest velocity. Raises PlanError."""
        return preview(data)

    def read(self, raw: bytes) -> dict[str, Any]:
        """Plan YAML as JSON. Raises PlanError."""
        if len(raw) > LARGEST_YAML:
            fix = "upload a long record and give its name, or send the plan as JSON"
            raise PlanError(Issue("", f"the YAML has {len(raw)} bytes; the limit is {LARGEST_YAML} bytes", fix=fix))
        try:
            data = plan_yaml.parse(raw.decode())
        except UnicodeDecodeError as error:
            problem = f"is not valid UTF-8 text: byte {error.start} is wrong"
            raise PlanError(Issue("", problem, fix="save the file as UTF-8")) from None
        refuse_unstorable(data)
        return read_plan(data).as_dict()

    def write(self, data: Any) -> str:
        refuse_unstorable(data)
        return plan_to_yaml(read_plan(data))


def _warnings(checked: Checked) -> list[str]:
    plan, found = checked.plan, []
    if plan.test != "client" and plan.duration and plan.duration < checked.moved_s:
        excitation = "drive" if plan.driven else "record" if plan.motion.kind != "none" else "force"
        found.append(f"The test ends at {plan.duration:g} s, before the end of its {excitation} at {checked.moved_s:g} s.")
    for station in plan.stations:
        if station.limits.force > station.actuator.force_limit:
            found.append(f"{station.name}: the force limit is above that of the actuator, so it can never trip.")
        if station.limits.velocity > station.actuator.velocity_limit:
            found.append(f"{station.name}: the velocity limit is above that of the actuator, so it can never trip.")
    unstable = stability.warning(checked.model)
    return [*found, unstable] if unstable else found
