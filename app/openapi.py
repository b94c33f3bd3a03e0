"""The OpenAPI description: the plan as its own JSON Schema, errors as they are sent, and examples."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from fastapi import FastAPI
from pydantic import BaseModel, ConfigDict, Field, WithJsonSchema

from app import openapi_rules
from app.config import PROBES
from app.openapi_examples import REQUESTS, example
from app.problems import MEDIA_TYPE, TITLES
from rths_engine.planning.plan import Plan

SCHEMAS = "#/components/schemas/"
IS_PLAN = {"type": "object", "x-form": "rths-plan/1"}  # the framework refuses references to what it did not generate
PLAN = WithJsonSchema(IS_PLAN)
PLAN_SAID = "A test plan, rths-plan/1. Numbers are SI; a number with a unit is also taken as text with its unit, `36007 kN/m`."
PlanData = Annotated[dict[str, Any], PLAN]  # checked by the engine, whose errors name the field

Responses = dict[int | str, dict[str, Any]]


class FileLine(BaseModel):
    """A line of an uploaded text file."""

    number: int
    text: str


class Issue(BaseModel):
    """One thing wrong with a request."""

    where: str = Field(description="path into the request, such as `plan.motion.scale.pga`; empty for the whole")
    problem: str = Field(description="the bound or the rule that is broken")
    value: str | None = Field(description="what was given")
    fix: str | None = Field(description="how to mend it")
    lines: list[FileLine] = Field([], description="the line that `where` names, with two lines before and after it")


class Problem(BaseModel):
    """An error (RFC 9457). Nothing of a refused request is stored."""

    model_config = ConfigDict(json_schema_extra={"required": ["type", "title", "status", "detail", "errors"]})

    type: str
    title: str
    status: int
    detail: str
    errors: list[Issue]


def told(*statuses: int) -> Responses:
    """Problems that a route answers with beside those that follow from its method, address and body."""
    return {status: _problem(TITLES[status]) for status in statuses}


def file(media_type: str) -> Responses:
    """A download."""
    schema = {"type": "string"} if media_type.startswith("text/") else {}
    return {200: {"description": "The file", "content": {media_type: {"schema": schema}}}}


def install(app: FastAPI) -> None:
    """Describe the application, once, when it is first asked for."""
    generated = app.openapi

    def described() -> dict[str, Any]:
        if not app.openapi_schema:
            _complete(generated())
        return generated()

    app.openapi = described  # type: ignore[method-assign]


def _complete(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]
    for name in ("HTTPValidationError", "ValidationError"):
        schemas.pop(name, None)
    schemas |= dict(_named("Plan", Plan)) | dict(_named("Problem", Problem))
    schemas["Plan"]["description"] = PLAN_SAID
    _refer(document)
    for path, item in document["paths"].items():
        for method, operation in item.items():
            operation["summary"] = _summary(operation["description"])
            responses = operation["responses"]
            if "HTTPValidationError" in str(responses.get("422")):
                del responses["422"]
            for status in _statuses(method, path, operation):
                responses.setdefault(str(status), _problem(TITLES[status]))
            responses["default"] = _problem("Any other error")
            _give_examples(f"{method.upper()} {path}", operation, schemas)
            openapi_rules.add(f"{method.upper()} {path}", operation)


def _summary(description: str) -> str:
    """The first sentence of an endpoint's docstring: by default the summary is the name of its function."""
    return description.split("\n\n")[0].replace("\n", " ").split(". ")[0].removesuffix(".")


def _refer(inside: Any) -> None:
    """Put the reference to a plan's schema wherever one stands."""
    if isinstance(inside, dict):
        if inside.items() >= IS_PLAN.items():
            inside.clear()
            inside["$ref"] = f"{SCHEMAS}Plan"
        for one in inside.values():
            _refer(one)
    elif isinstance(inside, list):
        for one in inside:
            _refer(one)


def _statuses(method: str, path: str, operation: dict[str, Any]) -> Iterator[int]:
    """The problems that follow from what a route takes."""
    if path not in PROBES:
        yield from (401, 403, 421, 503)
    if method != "get":
        yield from (409, 507)
    if "{" in path:
        yield 404
    if "requestBody" in operation:
        yield from (400, 408, 413, 415, 422)
    elif any(one["in"] == "query" for one in operation.get("parameters", [])):
        yield 422


def _problem(description: str) -> dict[str, Any]:
    return {"description": description, "content": {MEDIA_TYPE: {"schema": {"$ref": f"{SCHEMAS}Problem"}}}}


def _named(name: str, model: type[BaseModel]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The model's schema as `name` and the schemas in it as `name.KIND`, so that none takes another's name."""
    schema = model.model_json_schema(ref_template=f"{SCHEMAS}{name}.{{model}}")
    _only_names(schema)
    yield from ((f"{name}.{inner}", one) for inner, one in schema.pop("$defs", {}).items())
    yield name, schema


def _only_names(inside: Any) -> None:
    """Leave out discriminators that lead to a choice of schemas: OpenAPI allows names of schemas only. `oneOf` stays."""
    if isinstance(inside, dict):
        mapping = inside.get("discriminator", {}).get("mapping", {}) if isinstance(inside.get("discriminator"), dict) else {}
        if any(not isinstance(one, str) for one in mapping.values()):
            del inside["discriminator"]
        for one in inside.values():
            _only_names(one)
    elif isinstance(inside, list):
        for one in inside:
            _only_names(one)


def _give_examples(route: str, operation: dict[str, Any], schemas: dict[str, Any]) -> None:
    for media in operation.get("requestBody", {}).get("content", {}).values():
        if route in REQUESTS:
            media["example"] = REQUESTS[route]()
    for status, response in operation["responses"].items():
        media = response.get("content", {}).get("application/json", {})
        if status.startswith("2") and "$ref" in media.get("schema", {}):
            media["example"] = example(media["schema"], schemas)
