"""The compiled code on disk follows what is compiled, and nothing else."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numba
import pytest

from rths_engine.foundation import kernel
from rths_engine.foundation.fingerprint import Walk, fingerprint
from rths_engine.running import loop
from rths_engine.running.warm import warm

ENGINE = Path(kernel.__file__).parents[1]
PRINTED = """
from rths_engine.running import loop, passes, replay, stop
entries = (loop.advance, passes._specimen_all, replay._actuator, replay._compensator, replay._structure, stop.stop)
print(*(entry._cache._impl.locator.digest for entry in entries))
"""
COULOMB = "parts/physics/specimen/coulomb_friction.py"


def digests(folder: Path, *edits: tuple[str, str, str]) -> list[str]:
    """What the entry points would be kept under, after edits (file, old, new) to a copy of the engine."""
    shutil.copytree(ENGINE, folder / "rths_engine", ignore=shutil.ignore_patterns("__pycache__", "data"))
    for name, old, new in edits:
        file = folder / "rths_engine" / name
        text = file.read_text(encoding="utf-8")
        assert old in text, f"{name} holds no {old!r}"
        file.write_text(text.replace(old, new, 1), encoding="utf-8")
    command = [sys.executable, "-c", PRINTED]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout.split()


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    return digests(tmp_path_factory.mktemp("as_it_is"))


def test_words_bounds_and_guesses_compile_nothing_anew(kept: list[str], tmp_path: Path) -> None:
    reworded = digests(
        tmp_path,
        (COULOMB, "resists every motion with", "opposes every motion by"),
        (COULOMB, '"Coulomb friction"', '"Dry friction"'),
        (COULOMB, "in both directions", "against the motion"),
        (COULOMB, "ge=0, le=1e9", "ge=0, le=1e8"),
        (COULOMB, "0.1 * seen.f", "0.2 * seen.f"),
        (COULOMB, "        if s[2] > 0.0:", "        # once it has begun\n\n        if s[2] > 0.0:"),
        ("parts/physics/friction.py", "after a move in one direction", "after a move without reversal"),
        ("running/loop.py", "Integration steps first to last - 1.", "\n\n    From step `first` to `last` - 1."),
        ("planning/plan.py", "Untitled test", "Test"),
        ("running/run.py", "shorten the test", "take a shorter test"),
    )
    assert reworded == kept


@pytest.mark.parametrize(
    "edit",
    [
        (COULOMB, "return y + p[0] * s[1]", "return y - p[0] * s[1]"),
        ("parts/physics/friction.py", "return 1.0 - (1.0 - z)", "return 1.0 - (1.5 - z)"),
        ("parts/physics/specimen/velocity_exponent.py", "SLOW = 0.05", "SLOW = 0.06"),
        ("parts/structures/assembled.py", "    shape: Array\n    section: Array", "    section: Array\n    shape: Array"),
        (
            "parts/compensators/__init__.py",
            "    NoCompensation\n    | InverseCompensation\n",
            "    InverseCompensation\n    | NoCompensation\n",
        ),
        ("running/data.py", "    n: int  # substeps of an integration step\n", ""),
        ("foundation/kernel.py", '"fastmath": False', '"fastmath": True'),
    ],
    ids=["step", "helper", "constant", "field of an argument of an argument", "order of a registry", "field", "options"],
)
def test_what_is_compiled_is_compiled_anew_once_it_changed(edit: tuple[str, str, str], kept: list[str], tmp_path: Path) -> None:
    assert digests(tmp_path, edit)[0] != kept[0]


def test_what_an_entry_point_does_not_reach_does_not_compile_it_anew(kept: list[str], tmp_path: Path) -> None:
    changed = digests(tmp_path, ("running/stop.py", "held[k] = y / r", "held[k] = 2.0 * y / r"))
    assert changed[:-1] == kept[:-1] and changed[-1] != kept[-1]


def test_every_named_tuple_that_the_loop_is_given_is_in_its_digest() -> None:
    warm()
    known = Walk(loop.advance.py_func).tuples
    assert {kind for signature in loop.advance.signatures for kind in tuples(signature)} <= known


def tuples(of: Any) -> Iterator[type]:
    """The named tuples of a signature of numba types, and of their fields."""
    for one in of:
        if isinstance(one, numba.types.NamedTuple):
            yield one.instance_class
        if isinstance(one, numba.types.BaseTuple):
            yield from tuples(one)


def test_a_name_defined_below_an_entry_point_is_refused() -> None:
    with pytest.raises(NameError, match="before not_yet"):
        fingerprint(lambda x: not_yet + x)  # type: ignore[name-defined]  # noqa: F821


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
print(simulate(templates.template("two-storeys").model_copy(update={"duration": 0.5})).signals.tobytes().hex())
"""


def test_the_loop_kept_on_disk_is_not_disturbed_by_code_compiled_before_it_is_loaded() -> None:
    kept, mixed = (
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        for code in (RUN, FOLDED_FIRST + RUN)
    )
    assert kept and mixed == kept
