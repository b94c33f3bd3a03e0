"""`rths library`: a plan saved from the command line is the plan that the service lists."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.cli.main import main
from app.config import Settings
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml

PLAN = templates.template("linear-damper")


@pytest.fixture
def folder(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(settings.data)
    monkeypatch.setenv("RTHS_DATA", str(settings.data))
    (settings.data / "one.yaml").write_text(plan_to_yaml(PLAN))
    (settings.data / "two.yaml").write_text(plan_to_yaml(PLAN.model_copy(update={"seed": 5})))
    return settings.data


def test_plans_are_saved_listed_shown_and_compared(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def said(*arguments: str, code: int = 0) -> str:
        assert main(["library", *arguments]) == code
        return capsys.readouterr().out

    assert said("save", "one.yaml", "--name", "Brace", "--tag", "steel", "--by", "Ana") == "Brace: saved as version 1\n"
    assert said("save", "two.yaml", "--name", "Brace", "--comment", "Other noise") == "Brace: saved as version 2\n"
    assert said("save", "two.yaml", "--name", "Brace") == "Brace: unchanged: equal to version 2\n"
    heads, row = said("list", "steel").splitlines()
    assert heads.split()[:2] == ["Plan", "Version"] and row.split()[:2] == ["Brace", "2"] and row.endswith("steel")
    assert len(said("list", "--archived").splitlines()) == 1
    assert plan_from_yaml(said("show", "Brace@1")).seed == PLAN.seed and plan_from_yaml(said("show", "Brace")).seed == 5
    assert [line.split()[0] for line in said("show", "Brace", "--history").splitlines()] == ["2", "1"]
    assert said("diff", "Brace@1", "Brace", code=1).splitlines()[1].startswith("Seed of the sensor noise  0 ")
    assert said("diff", "two.yaml", "Brace@2") == "The two plans are equal.\n"


def test_what_cannot_be_saved_or_found_is_said(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "list.yaml").write_text("[1, 2]")
    (folder / "bad.yaml").write_text("duration: -1\n")
    for arguments, words in (
        (("show", "Brace"), "has no plan of this name"),
        (("save", "list.yaml"), "a plan is a mapping"),
        (("save", "bad.yaml"), "plan.duration = -1"),
        (("diff", "one.yaml", "Brace@2"), "has no plan of this name"),
    ):
        assert main(["library", *arguments]) == 2
        assert words in capsys.readouterr().err
