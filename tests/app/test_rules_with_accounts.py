"""Audit log, control of rigs and approvals with accounts: the account counts, whatever a request says."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.access import Role
from app.accounts import signing_in
from app.accounts.service import AccountService
from app.audit.tables import AuditEntry
from app.db import unit_of_work
from app.models import EMULATED
from tests.app.conftest import app_of, plan
from tests.app.people import PASSWORD, V1, Person, browser, lab, person, sign_in
from tests.app.test_contention import at_once

__all__ = ["browser", "lab", "person"]
CONTROL = f"{V1}/control/{EMULATED}"
RULES = {"one_driver": False, "approvals": False, "approvers": []}


def entries(client: TestClient) -> list[AuditEntry]:
    app_of(client).state.audit.waiting.join()
    with app_of(client).state.sessions() as session:
        return list(session.scalars(sa.select(AuditEntry).order_by(AuditEntry.number)))


def test_signing_in_is_recorded_with_the_account_and_a_refusal_without_what_was_typed(
    lab: TestClient, person: Person, browser: Callable[..., TestClient]
) -> None:
    person(Role.VIEWER, "Vera")
    assert sign_in(browser(), "typed by mistake").status_code == 401
    found = entries(lab)
    signed_in = [one for one in found if one.action == "sign_in"]
    refused = [one for one in found if one.action == "refused.sign_in"]
    assert "Vera" in {one.who for one in signed_in} and len(refused) == 1
    assert not [one for one in found if PASSWORD in one.details or "typed by mistake" in one.details + one.who]


def test_only_engineers_and_administrators_read_the_log(person: Person) -> None:
    answers = [person(role).get(f"{V1}/audit").status_code for role in Role]
    assert answers == [403, 403, 200, 200]


def test_everybody_reads_the_rules_and_who_approves(person: Person) -> None:
    head, viewer = person(Role.ADMINISTRATOR, "Chief"), person(Role.VIEWER, "Reader")
    person(Role.OPERATOR, "Olga")
    for one in (head, viewer):
        said = one.get("/settings").text
        assert "Rules of the laboratory" in said and "/settings/rules.js" in said
        form = said.partition('id="rules-form"')[2].partition("</form>")[0]
        assert ("disabled" in form) is (one is viewer)
    assert head.put(f"{V1}/rules", json=RULES | {"approvals": True, "approvers": ["Olga"]}).status_code == 200
    assert viewer.get(f"{V1}/rules").json()["approvers"] == ["Olga"]
    asked = head.post(f"{V1}/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    (seen,) = [one for one in viewer.get(f"{V1}/approvals").json()["approvals"] if one["id"] == asked]
    assert seen["refusal"].startswith("Administrators approve, and so do Olga.")
    assert head.post(f"{V1}/runs/{asked}/cancel", json={}).status_code == 200
    assert head.put(f"{V1}/rules", json=RULES).status_code == 200


def test_the_lab_page_says_to_each_what_the_person_may_do_about_a_held_queue(person: Person) -> None:
    head, driver, other = person(Role.ADMINISTRATOR, "Boss"), person(Role.OPERATOR, "Dina"), person(Role.OPERATOR, "Omar")
    assert head.put(f"{V1}/rules", json=RULES | {"one_driver": True}).status_code == 200
    assert driver.post(f"{CONTROL}/take", json={}).status_code == 200
    assert driver.post(f"{V1}/queue/hold", json={"reason": "oil"}).status_code == 200
    queued = head.put(f"{V1}/rules", json=RULES), head.post(f"{V1}/runs", json={"plan": plan()})
    assert head.put(f"{V1}/rules", json=RULES | {"one_driver": True}).status_code == 200
    for one in (driver, other):
        said = one.get("/lab").text
        assert '<span data-lacks="operator">an operator releases the queue</span>' in said
        button = said.partition('id="release"')[2].partition("</button>")[0]
        assert ("disabled" in button and "Dina drives Emulated laboratory" in button) is (one is other)
    assert driver.post(f"{V1}/queue/release", json={}).status_code == 200
    assert driver.post(f"{CONTROL}/release", json={}).status_code == 200
    assert head.put(f"{V1}/rules", json=RULES).status_code == 200 and queued[1].status_code == 201
    assert head.post(f"{V1}/runs/{queued[1].json()['runs'][0]['id']}/cancel", json={}).status_code == 200


def test_the_account_drives_and_approves_whatever_name_a_request_gives(lab: TestClient, person: Person) -> None:
    head, driver, other = person(Role.ADMINISTRATOR, "Head"), person(Role.ENGINEER, "Dora"), person(Role.ENGINEER, "Otto")
    assert other.put(f"{V1}/rules", json=RULES | {"one_driver": True}).status_code == 403
    assert head.put(f"{V1}/rules", json=RULES | {"one_driver": True}).status_code == 200
    assert driver.post(f"{CONTROL}/take", json={"by": "Otto"}).json()["driver"] == "Dora"
    run = {"plan": plan(), "submitted_by": "Dora"}
    assert other.post(f"{V1}/runs", json=run).status_code == 409
    assert other.post(f"{CONTROL}/take-over", json={"reason": "now"}).status_code == 403
    assert driver.post(f"{V1}/runs", json=run).status_code == 201
    assert head.put(f"{V1}/rules", json=RULES | {"approvals": True, "approvers": ["Otto"]}).status_code == 200
    waits = driver.post(f"{V1}/runs", json={**run, "submitted_by": "Otto"}).json()["runs"][0]
    assert (waits["state"], waits["submitted_by"]) == ("to approve", "Dora")
    (seen,) = [one for one in other.get(f"{V1}/approvals").json()["approvals"] if one["id"] == waits["id"]]
    decision = {"digest": seen["digest"], "by": "Otto"}
    assert driver.post(f"{V1}/approvals/{waits['id']}/approve", json=decision).status_code == 403
    assert other.post(f"{V1}/approvals/{waits['id']}/approve", json=decision).json()["decided_by"] == "Otto"
    last = entries(lab)[-1]
    assert (last.who, last.role, last.signed_in, last.action) == ("Otto", "engineer", "session", "approvals.approve")


def test_the_control_and_the_right_to_approve_go_to_accounts_that_may_operate(lab: TestClient, person: Person) -> None:
    head, driver = person(Role.ADMINISTRATOR), person(Role.ENGINEER)
    person(Role.OPERATOR, "Eng Neer")
    person(Role.VIEWER, "Vic Wer")
    gone = person(Role.OPERATOR, "Gone Away")
    with unit_of_work(app_of(lab).state.sessions) as session:
        AccountService(session).disable(AccountService(session).named("gone away"))
    assert gone is not driver and head.put(f"{V1}/rules", json=RULES).status_code == 200
    assert driver.post(f"{CONTROL}/take").status_code in {200, 409}
    assert head.post(f"{CONTROL}/take-over", json={"reason": "a test"}).status_code == 200
    for nobody in ("No Such Person", "Vic Wer", "Gone Away"):
        refused = head.post(f"{CONTROL}/hand-over", json={"to": nobody})
        assert refused.status_code == 422 and refused.json()["errors"][0]["where"] == "to", nobody
        refused = head.put(f"{V1}/rules", json=RULES | {"approvals": True, "approvers": ["eng neer", nobody]})
        assert refused.status_code == 422 and [one["where"] for one in refused.json()["errors"]] == ["approvers.1"]
        assert not head.get(f"{V1}/rules").json()["approvals"]
    assert head.post(f"{CONTROL}/hand-over", json={"to": " eng NEER"}).json()["driver"] == "Eng Neer"
    kept = head.put(f"{V1}/rules", json=RULES | {"approvers": ["eng neer", "Eng Neer"]})
    assert kept.json()["approvers"] == ["Eng Neer"]


@pytest.mark.parametrize(("word", "lost"), [("away", {"disabled": True}), ("below", {"role": "viewer"})])
def test_a_driver_whose_account_loses_its_right_gives_up_the_control(
    person: Person, word: str, lost: dict[str, object]
) -> None:
    head, driver, other = (
        person(role, f"{role.name.title()} {word}") for role in (Role.ADMINISTRATOR, Role.ENGINEER, Role.OPERATOR)
    )
    assert head.put(f"{V1}/rules", json=RULES | {"one_driver": True}).status_code == 200
    assert head.post(f"{CONTROL}/take-over", json={"reason": "a test"}).status_code == 200
    account = driver.get(f"{V1}/account").json()
    assert head.post(f"{CONTROL}/hand-over", json={"to": account["name"]}).status_code == 200
    assert other.post(f"{CONTROL}/take").status_code == 409
    ids = {one["name"]: one["id"] for one in head.get(f"{V1}/accounts").json()["accounts"]}
    assert head.patch(f"{V1}/accounts/{ids[account['name']]}", json=lost).status_code == 200
    (rig,) = head.get(f"{V1}/control").json()["rigs"]
    assert (rig["driver"], rig["sentence"]) == (None, "Nobody drives Emulated laboratory.")
    refused = other.post(f"{V1}/runs", json={"plan": plan()})
    assert refused.status_code == 409 and "Nobody drives Emulated laboratory" in refused.json()["detail"]
    assert other.post(f"{CONTROL}/take").status_code == 200
    assert head.put(f"{V1}/rules", json=RULES).status_code == 200


def test_an_account_has_no_more_tokens_than_the_limit_however_many_are_asked_for_at_once(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(signing_in, "MOST_TOKENS", 3)
    one = person(Role.ENGINEER)
    answers = at_once(8, lambda number: one.post(f"{V1}/account/tokens", json={"name": f"Script {number}"}))
    assert sorted(answer.status_code for answer in answers) == [201] * 3 + [409] * 5
    assert len(one.get(f"{V1}/account/tokens").json()["tokens"]) == 3
