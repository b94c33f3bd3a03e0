"""The laboratory's identity: stored in the data folder, given first by variables, and a logo that is only an image."""

from __future__ import annotations

import struct
import zlib
from dataclasses import replace
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from app.config import Settings, from_environment
from app.laboratory.logo import LARGEST
from app.laboratory.service import Laboratory
from app.main import create_app
from app.problems import NotFound
from rths_engine.foundation.errors import RthsError
from tests.app.conftest import ADDRESS, HERE

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 4"><path d="M0 0h8v4H0z" fill="#0c5f6e"/></svg>'


def png(width: int = 4, height: int = 2) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + b"\x0c\x5f\x6e" * min(width, 8) for _ in range(min(height, 8)))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def svg(inside: str) -> bytes:
    return f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">{inside}</svg>'.encode()


@pytest.fixture
def web(tmp_path: Path) -> TestClient:
    """The service without its database: the identity needs none."""
    settings = Settings(data=tmp_path, embedded_worker=False, local_sign_in=True)
    return TestClient(create_app(settings), ADDRESS, client=HERE)


def test_the_identity_is_set_shown_and_kept(web: TestClient, tmp_path: Path) -> None:
    first = web.get("/api/v1/laboratory").json()
    assert first == {"name": "", "address": "", "signatures": ["Test operator", "Checked by", "Approved by"], "logo": None}
    given = {"name": "Structures Laboratory", "address": "12 Harbour Road", "signatures": ["Approved by"]}
    assert web.put("/api/v1/laboratory", json=given).json() == given | {"logo": None}
    assert Laboratory(Settings(data=tmp_path)).identity.name == "Structures Laboratory"
    page = web.get("/settings")
    assert page.status_code == 200 and "12 Harbour Road" in page.text
    assert web.put("/api/v1/laboratory", json=given | {"name": "x" * 121}).status_code == 422


@pytest.mark.parametrize(("data", "kind"), [(SVG, "image/svg+xml"), (png(), "image/png")])
def test_a_logo_is_stored_answered_as_an_image_and_removed(web: TestClient, data: bytes, kind: str) -> None:
    stored = web.put("/api/v1/laboratory/logo", files={"file": ("logo", data)}).json()["logo"]
    assert stored["media_type"] == kind and stored["size"] == len(data)
    shown = web.get("/api/v1/laboratory/logo")
    assert shown.content == data and shown.headers["content-type"] == kind
    assert "sandbox" in shown.headers["content-security-policy"]
    assert web.delete("/api/v1/laboratory/logo").status_code == 204
    assert web.get("/api/v1/laboratory/logo").status_code == 404
    assert web.delete("/api/v1/laboratory/logo").status_code == 404


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "is empty"),
        (b"x" * (LARGEST + 1), "too large"),
        (b"GIF89a", "neither a PNG nor an SVG"),
        (b"<html/>", "outermost element"),
        (b"\x89PNG\r\n\x1a\n", "not a complete PNG"),
        (png(9000, 1), "9000 × 1 pixels"),
        (b"<!DOCTYPE svg [<!ENTITY a 'b'>]><svg>&a;</svg>", "document type declaration"),
        ("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg>&a;</svg>".encode("utf-16"), "document type declaration"),
        (svg("<script>alert(1)</script>"), "<script>"),
        (svg("<foreignObject/>"), "<foreignobject>"),
        (svg('<path onload="alert(1)"/>'), "script in its attribute onload"),
        (svg('<linearGradient xlink:href="http://elsewhere.example/a.svg#b"/>'), "attribute href"),
        (svg('<path fill="url(http://elsewhere.example/a)"/>'), "attribute fill"),
        (svg("<style>@import 'a.css';</style>"), "style sheet"),
    ],
)
def test_a_logo_that_is_no_plain_image_is_refused_with_the_reason(web: TestClient, data: bytes, problem: str) -> None:
    answer = web.put("/api/v1/laboratory/logo", files={"file": ("logo.svg", data)})
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["where"] == "logo" and problem in error["problem"] and "200 kB" in error["fix"]


def test_a_gradient_within_the_logo_is_no_reference_to_another_file(web: TestClient) -> None:
    inside = '<linearGradient id="a"/><path fill="url(#a)"/>'
    assert web.put("/api/v1/laboratory/logo", files={"file": ("a", svg(inside))}).status_code == 200


def test_variables_give_the_first_values_and_the_page_replaces_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "logo.svg").write_bytes(SVG)
    monkeypatch.setenv("RTHS_LABORATORY", "RTMD")
    monkeypatch.setenv("RTHS_LABORATORY_ADDRESS", "Bethlehem")
    monkeypatch.setenv("RTHS_LABORATORY_LOGO", str(tmp_path / "logo.svg"))
    settings = from_environment(data=tmp_path)
    laboratory = Laboratory(settings)
    assert (laboratory.identity.name, laboratory.identity.address) == ("RTMD", "Bethlehem")
    assert laboratory.logo is not None and laboratory.logo.data == SVG
    laboratory.remove_logo()
    assert laboratory.logo is None
    with pytest.raises(NotFound):
        laboratory.remove_logo()
    laboratory.save(laboratory.identity.model_copy(update={"name": "Other"}))
    assert Laboratory(settings).identity.name == "Other"
    missing = Laboratory(replace(settings, data=tmp_path / "new", laboratory_logo=tmp_path / "none.svg"))
    with pytest.raises(RthsError, match="RTHS_LABORATORY_LOGO"):
        _ = missing.logo


def test_a_damaged_identity_says_how_to_mend_it(web: TestClient, tmp_path: Path) -> None:
    (tmp_path / "laboratory").mkdir()
    (tmp_path / "laboratory" / "identity.json").write_text("{")
    assert "save the settings" in web.get("/api/v1/laboratory").json()["detail"]
    assert web.put("/api/v1/laboratory", json={"name": "Mended", "address": "", "signatures": []}).status_code == 200
