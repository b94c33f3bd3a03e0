"""The help: every document is a page whose links lead somewhere, and a search finds sections."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from app.help.documents import paths, sections
from app.help.search import search

FRONTEND = Path(__file__).parents[2] / "frontend"


def test_every_document_is_a_page_whose_links_lead_to_pages_and_headings(client: TestClient) -> None:
    for name in paths():
        answer = client.get(f"/help/{name}")
        assert answer.status_code == 200 and "style=" not in answer.text and "&lt;!--" not in answer.text, name
        for address in re.findall(r'(?:href|src)="(/help/[^"]+)"', answer.text):
            path, _, anchor = address.removeprefix("/help/").partition("#")
            if path.endswith(".md"):
                assert path in paths() and (not anchor or anchor in {one.anchor for one in sections(path)}), (name, address)
            else:
                media_type = client.get(address.partition("#")[0]).headers["content-type"]
                assert media_type.startswith("image/"), (name, address)


def test_every_link_of_a_page_or_a_script_into_the_help_leads_to_a_document() -> None:
    for path in (*FRONTEND.glob("templates/**/*.html"), *FRONTEND.glob("static/js/**/*.js")):
        for address in re.findall(r"[\"'`]/help/([^\"'`#?]+)", path.read_text()):
            assert "{" in address or address in paths(), (path.name, address)


def test_a_search_finds_the_section_that_explains_the_words() -> None:
    found = search("delay margin")
    assert any("stability" in one.address for one in found[:5])
    assert all("".join(text for text, _ in one.excerpt) for one in found)
    assert any(marked for one in found for _, marked in one.excerpt)
    assert search("   ") == [] and search("xyzzy") == []


def test_the_page_of_a_search_says_what_to_try_and_escapes_what_was_typed(client: TestClient) -> None:
    assert "Try fewer words" in client.get("/help?q=xyzzy").text
    assert "<b>x" not in client.get("/help", params={"q": "<b>x"}).text


@pytest.mark.parametrize(
    "name", ["docs/nothing.md", "pyproject.toml", "docs/../pyproject.toml", "app/main.py", "docs/nothing.png"]
)
def test_only_documents_and_their_pictures_are_served(serving: TestClient, name: str) -> None:
    assert serving.get(f"/help/{name}").status_code == 404


def test_the_glossary_has_every_term_with_its_meaning(client: TestClient) -> None:
    terms = {one["term"]: one for one in client.get("/api/v1/glossary").json()["terms"]}
    assert terms["Tracking indicator"]["symbol"] == "TI" and terms["Delay margin"]["meaning"]
