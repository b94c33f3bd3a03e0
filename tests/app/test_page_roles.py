"""What a role may not do, the pages do not offer: each control names the role that the route behind it needs."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import pytest
from starlette.routing import Match

from app.access import Role
from app.config import Settings
from app.gate import Place, places
from app.main import create_app
from app.pages.rendering import FRONTEND
from tests.app.page_controls import CONTROLS

SCRIPTS, TEMPLATES = FRONTEND / "static" / "js", FRONTEND / "templates"
CALL = re.compile(r"\bapi\.(post|send|patch|put|putForm|remove|postForText|postText|postForm)\(\s*")
METHODS = {"patch": "PATCH", "put": "PUT", "putForm": "PUT", "remove": "DELETE"}
CLOSED = {"(": ")", "[": "]", "{": "}"}
VOID = {"input", "link", "meta", "br", "img", "hr"}
MADE_FOR = {"/new": Role.OPERATOR, "/sweeps/new": Role.ENGINEER}
"""Pages that everyone may read, but that serve only to do what a role may do."""
READ = ("/new?library=", "/new?template=")  # the form shows these plans to everyone
OWN = {"audit.html"}  # pages that only those open who may use their links

Needs = dict[str, set[str]]  # roles that an element or those around it need, by `#id` or `[data-remove]`


def sent(script: Path) -> Iterator[str]:
    """The calls of a script that may change something: method and address as written."""
    text = script.read_text()
    for call in CALL.finditer(text):
        yield f"{METHODS.get(call[1], 'POST')} {argument(text, call.end())}"


def argument(text: str, start: int) -> str:
    """The first argument of a call, up to its comma or bracket outside of texts and brackets."""
    open_ones: list[str] = []
    for at in range(start, len(text)):
        sign, inner = text[at], open_ones[-1] if open_ones else ""
        if inner in {'"', "`"}:
            if sign == inner:
                open_ones.pop()
            elif inner == "`" and text[at - 1 : at + 1] == "${":
                open_ones.append("}")
        elif sign in {'"', "`"}:
            open_ones.append(sign)
        elif sign in CLOSED:
            open_ones.append(CLOSED[sign])
        elif sign == inner:
            open_ones.pop()
        elif not open_ones and sign in ",)":
            return text[start:at]
    raise AssertionError(f"a call has no end: {text[start : start + 80]}")


@pytest.fixture(scope="module")
def routes(tmp_path_factory: pytest.TempPathFactory) -> list[Place]:
    return places(create_app(Settings(data=tmp_path_factory.mktemp("roles"), embedded_worker=False)))


def role_of(routes: list[Place], route: str) -> Role | None:
    """The role that a route needs, `POST /queue/hold`; the lowest for those that need none, and None for an unknown address."""
    method, path = route.split(" ")
    for place in routes:
        if place.match("http", method, path) is Match.FULL and place.path != "/{path:page}":
            assert place.access
            return place.access.who if isinstance(place.access.who, Role) else Role.VIEWER
    return None


def named(call: str) -> str:
    """The route that a call names: its variables are one path segment each."""
    method, raw = call.split(" ", 1)
    return f"{method} /api/v1{re.sub(r'[?].*', '', re.sub(r'[$][{][^}]*[}]', '1', raw)).strip('`' + chr(34))}"


class Elements(HTMLParser):
    """The needs of the elements of a template, and of the links to pages."""

    def __init__(self) -> None:
        super().__init__()
        self.around: list[tuple[str, str | None]] = []
        self.needs: Needs = {}
        self.links: list[tuple[str, set[str]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        needs = {role for _, role in [*self.around, (tag, given.get("data-needs"))] if role}
        for key in [f"#{given['id']}"] if given.get("id") else []:
            self.needs[key] = needs
        if "data-remove" in given:
            self.needs["[data-remove]"] = needs
        if tag == "a" and given.get("href"):
            self.links.append((str(given["href"]), needs))
        if tag not in VOID:
            self.around.append((tag, given.get("data-needs")))

    def handle_endtag(self, tag: str) -> None:
        while self.around and self.around.pop()[0] != tag:
            pass


@cache
def elements(template: Path) -> Elements:
    found = Elements()
    found.feed(re.sub(r"\{%.*?%\}|\{\{.*?\}\}", "", template.read_text(), flags=re.DOTALL))
    return found


def needs_of(control: str) -> list[set[str]]:
    """The roles that a control of the table names, for each place where it stands."""
    where = re.fullmatch(r"(\w+\.html)(.*)", control)
    if where:
        return [elements(TEMPLATES / where[1]).needs[where[2]]]
    script, fragment = control.split(" ", 1)
    lines = [line for line in (SCRIPTS / script).read_text().splitlines() if fragment in line]
    return [set(re.findall(r'"(viewer|operator|engineer|administrator)"', line)) for line in lines]


def test_every_call_of_a_page_is_tied_to_controls_that_need_the_role_of_its_route(routes: list[Place]) -> None:
    calls = {
        (str(script.relative_to(SCRIPTS)), call)
        for script in SCRIPTS.rglob("*.js")
        if script.name != "api.js"
        for call in sent(script)
    }
    free = {one for one in calls if one not in CONTROLS and role_of(routes, named(one[1])) is Role.VIEWER}
    assert len(calls) > 80 and len(free) > 15
    assert calls - free == set(CONTROLS), "name the controls of each call in tests/app/page_controls.py"
    for (script, call), (given, controls) in CONTROLS.items():
        needed = {role_of(routes, route.replace(" ", " /api/v1")) for route in given} or {role_of(routes, named(call))}
        assert len(needed) == 1 and None not in needed, (script, call, needed)
        role = needed.pop()
        assert role is Role.VIEWER or controls, (script, call)
        for control in controls:
            found = needs_of(control)
            assert found, f"there is no {control}"
            assert all({str(role and role.name.lower())} == one for one in found), (script, call, control, found, role)


def test_every_link_to_a_page_that_a_role_may_not_use_is_hidden_from_it(routes: list[Place]) -> None:
    met = set()
    for template in TEMPLATES.glob("*.html"):
        for href, needs in elements(template).links if template.name not in OWN else ():
            path = href.partition("?")[0]
            role = MADE_FOR.get(path) or (role_of(routes, f"GET {path}") if re.fullmatch(r"/[/\w-]*", path) else None)
            if role and role > Role.VIEWER and not href.startswith(READ):
                met.add(path)
                assert needs & {one.name.lower() for one in Role if one >= role}, (template.name, href, needs)
    assert met == {"/audit", *MADE_FOR}
