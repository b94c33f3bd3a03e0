"""The compiled code on disk follows the sources."""

from __future__ import annotations

from pathlib import Path

import pytest

from rths_engine import kernel


def test_the_cache_folder_is_keyed_by_every_source_of_the_engine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "specimens").mkdir()
    part = tmp_path / "specimens" / "part.py"
    part.write_text("a = 1\n")
    monkeypatch.setattr(kernel, "__file__", str(tmp_path / "kernel.py"))
    before = kernel.source_digest()
    part.write_text("a = 2\n")
    assert kernel.source_digest() != before


def test_fold_calls_the_step_of_its_code() -> None:
    dispatch = kernel.fold([lambda x: x + 1.0, lambda x: x * 10.0, lambda x: -x])
    assert [dispatch(code, 3.0) for code in range(3)] == [4.0, 30.0, -3.0]
