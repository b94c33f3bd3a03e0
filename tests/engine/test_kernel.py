"""The compiled code on disk follows the sources."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rths_engine.foundation import kernel


def test_the_cache_folder_is_keyed_by_every_source_of_the_engine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "specimens").mkdir()
    part = tmp_path / "specimens" / "part.py"
    part.write_text("a = 1\n")
    monkeypatch.setattr(kernel, "__file__", str(tmp_path / "foundation" / "kernel.py"))
    before = kernel.source_digest()
    part.write_text("a = 2\n")
    assert kernel.source_digest() != before


def test_fold_calls_the_step_of_its_code() -> None:
    dispatch = kernel.fold([lambda x: x + 1.0, lambda x: x * 10.0, lambda x: -x])
    assert [dispatch(code, 3.0) for code in range(3)] == [4.0, 30.0, -3.0]


FOLDED_FIRST = """
from rths_engine.parts import compensators
from rths_engine.foundation.kernel import fold
dispatch = fold([part.step for part in compensators.KINDS])
for code, part in enumerate(compensators.KINDS):
    dispatch(code, *part().build(1 / 1024), 0.0, 0.0, 0.0, 0.0, 1 / 1024)
"""
RUN = """
from rths_engine.planning import templates
from rths_engine.running.run import simulate
print(simulate(templates.template("table3-04").model_copy(update={"duration": 0.5})).signals.tobytes().hex())
"""


def test_the_loop_kept_on_disk_is_not_disturbed_by_code_compiled_before_it_is_loaded() -> None:
    kept, mixed = (
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        for code in (RUN, FOLDED_FIRST + RUN)
    )
    assert kept and mixed == kept
