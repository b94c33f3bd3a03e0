"""Every operation of the OpenAPI description answers valid and invalid requests as it says, never with a server error."""

from __future__ import annotations

from fastapi.testclient import TestClient

from app.openapi_rules import RULES
from tests.app.conftest import app_of
from tests.app.test_openapi import ROUTES
from tests.fuzz.api import faults, operations


def test_every_operation_keeps_its_description_under_made_requests(earlier: TestClient) -> None:
    found = [
        fault
        for operation in operations(app_of(earlier))
        for fault in faults(earlier, operation, examples=1, seed=1, patient=False)
    ]
    assert found == [], "\n".join(found)


def test_the_rules_beside_the_schemas_are_of_routes_that_are_there() -> None:
    assert RULES.keys() <= set(ROUTES)
