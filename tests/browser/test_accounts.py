"""Signing in by the keyboard, the first administrator, the own account and the accounts of others."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
import uvicorn
from playwright.sync_api import Page, ViewportSize, expect

from app.access import Role
from app.accounts.service import AccountService
from app.config import Settings
from app.db import unit_of_work
from app.main import create_app
from tests.app.conftest import plan
from tests.app.people import PASSWORD
from tests.browser.conftest import visit
from tests.browser.contexts import Contexts
from tests.browser.service import free_port, until
from tests.browser.test_pages import expect_accessible

NARROW: ViewportSize = {"width": 390, "height": 800}


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str]]:
    """A control room with accounts and no worker: its address, and the path of the link of a new account."""
    settings = Settings(data=tmp_path_factory.mktemp("accounts"), port=free_port(), embedded_worker=False)
    app = create_app(settings)
    app.state.calculations.processes.start()  # they load their modules while the first pages are open
    server = uvicorn.Server(uvicorn.Config(app, port=settings.port, log_level="error", timeout_graceful_shutdown=1))
    thread = threading.Thread(target=server.run)
    thread.start()
    until(lambda: server.started, bool)
    with unit_of_work(app.state.sessions) as session:
        accounts = AccountService(session)
        accounts.add("Ana Ruiz", Role.ADMINISTRATOR, PASSWORD)
        accounts.add("Vera Holm", Role.VIEWER, PASSWORD)
        path, _ = accounts.link(accounts.add("Ben Osei", Role.ENGINEER))
    yield f"http://127.0.0.1:{settings.port}", path
    server.should_exit = True
    thread.join(30)


@pytest.fixture
def page(contexts: Contexts, lab: tuple[str, str]) -> Iterator[Page]:
    with contexts.taken() as take:
        yield take(lab[0], viewport=NARROW, color_scheme="dark", reduced_motion="reduce").new_page()


def whole(page: Page) -> None:
    """The page is accessible and does not scroll sideways."""
    expect_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), f"{page.url} scrolls sideways"


def test_a_person_signs_in_by_the_keyboard_manages_the_account_and_signs_out(page: Page) -> None:
    page.goto("/settings?from=mail")
    expect(page.get_by_label("Name")).to_be_focused()
    page.keyboard.type("ana ruiz")
    page.keyboard.press("Tab")
    page.keyboard.type("a wrong password\n")
    expect(page.get_by_role("alert")).to_have_text("The name or the password is not correct.")
    whole(page)
    page.keyboard.type(f"{PASSWORD}\n")  # the wrong one is selected
    page.wait_for_url("**/settings?from=mail")
    page.locator("#account-name").fill("Carla Nunes")
    page.get_by_role("button", name="Add the account").click()
    expect(page.locator("#account-link")).to_contain_text("/sign-in/link#")
    expect(page.locator("#account-rows")).to_contain_text("has no password yet")
    whole(page)
    visit(page, "/account")
    page.locator("#token-name").fill("nightly sweep")
    page.get_by_role("button", name="Make the token").click()
    expect(page.locator("#token-made")).to_contain_text("rths_")
    expect(page.locator("#token-rows")).to_contain_text("nightly sweep")
    whole(page)
    visit(page, "/new")
    expect(page.locator("#who")).to_be_hidden()
    for width, tallest in ((390, 70), (1400, 45)):  # px: the name, buttons and, on a wide window, the pages in one row
        page.set_viewport_size({"width": width, "height": 800})
        assert page.locator("header.top").evaluate("header => header.offsetHeight") <= tallest, width
    page.locator(".person summary").press("Enter")
    page.get_by_role("button", name="Sign out").press("Enter")
    page.wait_for_url("**/sign-in")
    page.goto("/account")
    expect(page).to_have_url(f"{page.url.partition('/sign-in')[0]}/sign-in?to=%2Faccount")


def test_an_open_page_says_that_the_session_has_ended_and_goes_on_after_a_new_sign_in(page: Page, lab: tuple[str, str]) -> None:
    def enter() -> None:
        done = page.context.request.post(f"{lab[0]}/api/v1/sign-in", data={"name": "Ana Ruiz", "password": PASSWORD})
        assert done.status == 204

    enter()
    queued = page.context.request.post(f"{lab[0]}/api/v1/runs", data={"plan": plan()}).json()["runs"][0]
    visit(page, f"/runs/{queued['id']}")
    assert page.context.request.post(f"{lab[0]}/api/v1/sign-out").status == 204
    notice = page.locator(".signed-out")
    expect(notice).to_contain_text("You are signed out: your session has ended.")
    expect(page.locator("#link")).to_have_text("No live data: your session has ended")
    bar = page.get_by_role("region", name="Abort")
    expect(bar.get_by_role("link", name="Sign in to abort")).to_be_visible()
    whole(page)
    assert page.url.endswith(f"/runs/{queued['id']}")  # nothing of the page is lost
    enter()  # in another tab
    expect(notice).to_have_count(0)
    expect(bar).to_be_hidden()
    expect(page.locator("#link")).to_have_text("")
    page.context.request.post(f"{lab[0]}/api/v1/sign-out")
    notice.get_by_role("link", name="Sign in and return to this page").press("Enter")
    expect(page.get_by_label("Name")).to_be_focused()
    page.keyboard.type("Ana Ruiz")
    page.keyboard.press("Tab")
    page.keyboard.type(f"{PASSWORD}\n")
    page.wait_for_url(f"**/runs/{queued['id']}")


def test_a_link_chooses_the_password_and_signs_in_once(page: Page, lab: tuple[str, str]) -> None:
    page.goto(lab[1])
    expect(page.get_by_role("heading", name="Choose a password for Ben Osei")).to_be_visible()
    assert "#" not in page.url  # nor in the history
    whole(page)
    page.locator("#password").fill(PASSWORD)
    page.locator("#again").fill("another password")
    page.get_by_role("button", name="Save the password").click()
    expect(page.get_by_role("alert")).to_contain_text("The two passwords differ")
    page.locator("#again").fill(PASSWORD)
    page.get_by_role("button", name="Save the password").click()
    expect(page.locator(".person summary")).to_have_text("Ben Osei")
    page.goto(lab[1])
    expect(page.get_by_role("alert")).to_contain_text("The link is not valid")


READING = {"Events", "Light theme", "Open", "Add filter", "Choose columns", "Export CSV", "Abort"}
"""What a viewer may press on the pages: everything else is for higher roles."""


def test_a_viewer_sees_no_control_of_a_higher_role(page: Page) -> None:
    page.request.post("/api/v1/sign-in", data={"name": "Vera Holm", "password": PASSWORD})
    for path in ("/queue", "/plans", "/runs", "/recordings", "/settings"):
        visit(page, path)
        shown = page.locator(":is(button, a.button, input[type=file]):visible:enabled").all_inner_texts()
        assert set(shown) <= READING, path
    expect(page.get_by_text("Only an administrator changes these settings.")).to_be_visible()
    expect(page.get_by_label("Address line")).to_be_disabled()
    whole(page)
    page.goto("/audit")
    expect(page.get_by_role("heading", name="Forbidden")).to_be_visible()
    whole(page)
