"""Requests made from the OpenAPI description, valid and invalid, and what is wrong with the answers to them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import hypothesis
import schemathesis
from fastapi import FastAPI
from fastapi.testclient import TestClient
from schemathesis import Case, GenerationMode
from schemathesis.checks import load_all_checks
from schemathesis.core.failures import Failure, FailureGroup
from schemathesis.specs.openapi import checks

from tests.fuzz.trying import each_once

load_all_checks()
CHECKS = [
    checks.status_code_conformance,
    checks.content_type_conformance,
    checks.response_headers_conformance,
    checks.response_schema_conformance,
    checks.missing_required_header,
    checks.allow_header_conformance,
    checks.negative_data_rejection,
    checks.unsupported_method,
]
MODES = (GenerationMode.POSITIVE, GenerationMode.NEGATIVE)
OF_THE_ENGINE = ("application/yaml", "multipart/form-data")  # bodies whose rules no schema can state
OF_PLANS = {"plan", "plans", "sweep", "mapping", "recording", "heldout", "drive"}  # fields with rules of the engine


def operations(app: FastAPI) -> list[Any]:
    """Every operation of the description."""
    found: list[Any] = list(schemathesis.openapi.from_dict(app.openapi()).get_all_operations())
    return [one.ok() for one in found]


def faults(client: TestClient, operation: Any, examples: int, seed: int, patient: bool = True) -> Iterator[str]:
    """What is wrong with the answers of an operation to `examples` valid and as many invalid requests, each fault once.

    Most operations without a body have no invalid request, which takes thousands of draws to find out, or 50 if not `patient`.
    """
    for mode in MODES:
        try:
            strategy = operation.as_strategy(generation_mode=mode)
            yield from each_once(strategy, partial(_faults_of, client), examples, seed, patient)
        except (hypothesis.errors.Unsatisfiable, hypothesis.errors.InvalidArgument, hypothesis.errors.FailedHealthCheck):
            continue  # an operation without parameters has no invalid request


def _faults_of(client: TestClient, case: Case[Any]) -> Iterator[str]:
    asked = case.as_transport_kwargs(base_url=str(client.base_url))
    asked.pop("cookies", None)
    if isinstance(asked.get("data"), bytes | str):
        asked["content"] = asked.pop("data")
    try:
        answer = client.request(**asked)
    except UnicodeEncodeError:  # a path that no client can send
        return
    answer.request.read()  # the checks quote it
    told = f"{case.method} {answer.request.url} -> {answer.status_code} {answer.text[:300]}"
    documented = case.operation.definition.raw.get("responses", {})
    if answer.status_code >= 500 and str(answer.status_code) not in documented:
        yield f"server error: {told}"
        return
    for check in CHECKS:
        if check is checks.negative_data_rejection and _spaced(case):
            continue
        try:
            case.validate_response(answer, checks=[check])
        except FailureGroup as group:
            yield from (f"{type(one).__name__}: {one.message} {told}" for one in group.exceptions)
        except Failure as one:
            yield f"{type(one).__name__}: {one.message} {told}"
    positive = case.meta is not None and case.meta.generation.mode.is_positive
    if positive and answer.status_code in {400, 415, 422} and not _ruled(case, answer):
        yield f"valid request refused: {told}"


def _spaced(case: Case[Any]) -> bool:
    """Whether a text of a request has spaces around it: the service measures names and tags without them."""
    left: list[Any] = [case.body, case.query]
    while left:
        one = left.pop()
        if isinstance(one, str) and one != one.strip():
            return True
        left += one.values() if isinstance(one, dict) else one if isinstance(one, list) else ()
    return False


def _ruled(case: Case[Any], answer: Any) -> bool:
    """Whether a refusal follows from a rule that no schema can state: `x-rules`, or rules of the engine."""
    described = case.operation.definition.raw
    content = described.get("requestBody", {}).get("content", {})
    if any(kind in content for kind in OF_THE_ENGINE):
        return True
    rules = described.get("x-rules", {})
    if "*" in rules:
        return True
    wheres = [str(one["where"]).split(".")[0] for one in answer.json()["errors"]]
    return bool(wheres) and all(where in rules or where in OF_PLANS for where in wheres)
