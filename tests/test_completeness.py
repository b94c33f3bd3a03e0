"""Nothing of a registry is left without its row in the documents, a test of its own and, for an effect, a proof case."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from app.documents.fields import name
from app.documents.regions import documents
from rths_engine.parts import actuators, compensators, controllers, integrators, physics, specimens, structures
from rths_engine.planning.shapes import SHAPES
from tests.proof.generator.draw import KINDS as DRAWN

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
ROOMS = (structures, integrators, compensators, actuators, specimens, controllers)
PARTS = [part for room in ROOMS for part in room.KINDS]
TESTS = "\n".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "tests" / "engine").glob("test_*.py")))
# which kinds of proof conceal the effects of a registry, and what the generator puts before their names
PROOFS = {
    "SPECIMEN": (("specimen",), ""),
    "ACTUATOR": (("actuator",), ""),
    "SENSOR": (("specimen", "actuator"), "sensor_"),
    "STRUCTURE": (("structure",), ""),
    "INPUT": (("structure",), "input_"),
}
# λ of these is zero: a fit of the plan's own numbers takes them up, so that no recording can prove them
ABSORBED = {"sensor_scale_error"}


def called(part: type[Any]) -> str:
    return f"{part.__module__.rsplit('.', 2)[1]}.{part.__name__}"


@pytest.mark.parametrize("registry", PROOFS)
def test_every_effect_has_a_proof_case_and_every_proof_case_an_effect(registry: str) -> None:
    kinds, before = PROOFS[registry]
    effects = {before + name(effect) for effect in getattr(physics, registry)}
    others = {prefix for _, prefix in PROOFS.values() if prefix} - {before}
    concealed = {
        one
        for one in chain.from_iterable(DRAWN[kind].single for kind in kinds)
        if one.startswith(before) and not one.startswith(tuple(others))
    }
    missing = effects - concealed - ABSORBED
    assert not missing, f"{sorted(missing)}: no proof case in tests/proof/generator; see docs/guides/add-a-left-out-effect.md"
    assert not concealed - effects, f"{sorted(concealed - effects)}: concealed by the generator and not in the library"


@pytest.mark.parametrize("part", [*PARTS, *physics.KINDS], ids=called)
def test_every_part_and_effect_has_a_test_of_its_own(part: type[Any]) -> None:
    """Contracts run over whole registries; a closed form of its own is in a file of tests/engine that names it.

    The effects of the two sensors share their file, and one test.
    """
    together = [one.__name__ for one in (*PARTS, *physics.KINDS) if one.__module__ == part.__module__]
    wanted = rf"\b({'|'.join(together)})\b|[\"']{re.escape(name(part))}[\"']"
    assert re.search(wanted, TESTS), f"no test in tests/engine names {part.__name__}"


@pytest.mark.parametrize("part", [*PARTS, *SHAPES], ids=called)
def test_every_part_has_a_row_in_the_documents(part: type[Any]) -> None:
    assert f"| `{name(part)}` | {part.title} |" in (DOCS / "parts.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("effect", physics.KINDS, ids=called)
def test_every_effect_has_a_row_in_the_documents(effect: type[Any]) -> None:
    row = rf"^\| `{name(effect)}( \([a-z_]+\))?` \| {re.escape(effect.title)} \|"
    assert re.search(row, (DOCS / "physics.md").read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.__name__.rsplit(".", 1)[1])
def test_every_file_of_a_room_with_a_part_is_in_its_registry(room: ModuleType) -> None:
    """A file whose class declares a `kind` and that the registry forgets would be in no form and no test."""
    (folder,) = room.__path__
    declaring = {path.stem for path in Path(folder).glob("*.py") if re.search(r"^    kind: Literal\[", path.read_text(), re.M)}
    assert declaring == {part.__module__.rsplit(".", 1)[1] for part in room.KINDS}


def test_every_file_with_an_effect_is_in_its_registry() -> None:
    (folder,) = physics.__path__
    declaring = {path for path in Path(folder).rglob("*.py") if re.search(r"^    kind: Literal\[", path.read_text(), re.M)}
    registered = {Path(folder, *effect.__module__.split(".")[-2:]).with_suffix(".py") for effect in physics.KINDS}
    assert declaring <= registered  # an effect of a storey may inherit its kind from that of a specimen


def test_every_page_of_the_menu_is_opened_by_the_browser_tests() -> None:
    menu = re.findall(r'\("(/[a-z0-9/]*)", "', (ROOT / "frontend" / "templates" / "base.html").read_text(encoding="utf-8"))
    opened = (ROOT / "tests" / "browser" / "test_pages.py").read_text(encoding="utf-8")
    assert len(menu) > 5 and not [page for page in menu if page != "/api/docs" and f'    "{page}' not in opened]


def test_the_index_names_every_document() -> None:
    index = (DOCS / "README.md").read_text(encoding="utf-8")
    linked = set(re.findall(r"\]\(([^)#]+\.md)\)", index))
    wanted = {path for path in documents() if path.parent != ROOT} - {DOCS / "README.md"}
    wanted |= {ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *(DOCS / "decisions").glob("*.md")}
    assert {(DOCS / one).resolve() for one in linked} == wanted | {ROOT / "README.md"}


@pytest.mark.parametrize("path", documents(), ids=lambda path: path.name)
def test_links_between_documents_lead_to_files(path: Path) -> None:
    links = re.findall(r"\]\((?!https?:)([^)#]+)", path.read_text(encoding="utf-8"))
    assert not [link for link in links if not (path.parent / link).exists()]
