"""docs/opensees.md: what makes a correct comparison with OpenSees look wrong, each statement seen in OpenSees itself."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rths_engine.recordings import measured
from rths_engine.recordings.measured import Mapping
from tests.opensees import peer

OMEGA = 2 * np.pi
PAGE = (Path(__file__).parents[2] / "docs" / "opensees.md").read_text(encoding="utf-8")
DECAY = np.exp(-0.05 * OMEGA * 9)  # of 5 % damping over nine periods


@pytest.fixture(scope="module")
def seen() -> dict[str, Any]:
    if reason := peer.missing():
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(reason)
    return peer.answered({"task": "habits"})


def off(path: list[float], dt: float, shift: float = 0.0) -> float:
    """Largest difference from the response to a step load, 1 - cos(omega t), `shift` steps later."""
    t = dt * (np.arange(1, len(path) + 1) + shift)
    return float(np.abs(np.array(path) - 1 + np.cos(OMEGA * t)).max())


def times(seen: dict[str, Any], name: str) -> np.ndarray:
    return np.array([float(row[0]) for row in seen["recorder"][name]])


def imported(seen: dict[str, Any], name: str) -> tuple[measured.Measured, str]:
    """A recorder's file as a recording, and the warnings about it."""
    text = "\n".join(" ".join(row) for row in seen["recorder"][name])
    table = measured.read(text.encode(), "recorded.out")
    channels = [{"column": 1, "role": "t", "unit": "s"}, {"column": 2, "role": "x_meas", "unit": "m"}]
    found = measured.imported(table, Mapping.read({"channels": channels}))
    return found, " ".join(map(str, found.warnings))


def test_the_page_names_the_version_that_is_tested(seen: dict[str, Any]) -> None:
    assert f"openseespy {seen['version']}" in PAGE


def test_a_path_by_step_is_zero_at_its_own_last_point_and_a_path_by_times_after_it(seen: dict[str, Any]) -> None:
    assert seen["path"] == {
        "dt": [1.0, 0.0, 0.0],
        "dt_last": [1.0, 1.0, 1.0],
        "time": [1.0, 1.0, 0.0],
        "time_last": [1.0, 1.0, 0.0],  # -useLast has no effect with -time
    }


def test_a_free_release_starts_with_zero_acceleration(seen: dict[str, Any]) -> None:
    wrong, right = [], []
    for dt, paths in seen["release"].items():
        exact = np.cos(OMEGA * float(dt) * np.arange(1, len(paths[0]) + 1))
        wrong.append(np.abs(np.array(paths[0]) - exact).max())
        right.append(np.abs(np.array(paths[1]) - exact).max())
    assert wrong[0] / wrong[1] < 2.6 and wrong[1] > 4 * right[1]  # first order
    assert right[0] / right[1] == pytest.approx(4, rel=0.02)  # second order with setNodeAccel


def test_central_difference_runs_half_a_step_ahead_of_a_load_that_begins_at_full_size(seen: dict[str, Any]) -> None:
    ahead, behind = seen["step_load"]["CentralDifference"], seen["step_load"]["Newmark"]
    assert off(ahead["0.01"], 0.01) == pytest.approx(0.0332, abs=1e-4)
    assert off(ahead["0.02"], 0.02, 0.5) / off(ahead["0.01"], 0.01, 0.5) == pytest.approx(4, rel=0.02)
    assert off(ahead["0.01"], 0.01, 0.5) < 0.06 * off(ahead["0.01"], 0.01)
    assert off(behind["0.01"], 0.01, -0.5) < 0.11 * off(behind["0.01"], 0.01)  # Newmark: half a step behind


def test_the_acceleration_that_kr_alpha_reports_does_not_balance_the_forces(seen: dict[str, Any]) -> None:
    lacks = {}
    for rho, releases in seen["kr_alpha"].items():
        for turn, one in zip((0.5, 0.1), releases, strict=True):
            spring = OMEGA**2 * np.array(one["x"])
            lacks[float(rho), turn] = float(np.linalg.norm(np.array(one["a"]) + spring) / np.linalg.norm(spring))
    assert lacks[1.0, 0.5] < 1e-12
    assert lacks[0.5, 0.5] == pytest.approx(0.147, abs=1e-3) and lacks[0.0, 0.5] == pytest.approx(0.334, abs=1e-3)
    for rho in (0.5, 0.0):  # acceleration and displacement are (1 - rho) / (1 + rho) of a step apart
        assert lacks[rho, 0.1] == pytest.approx((1 - rho) / (1 + rho) * 0.1, rel=0.03)


def test_rayleigh_damping_reaches_beam_columns_and_sections_but_neither_springs_nor_trusses(seen: dict[str, Any]) -> None:
    damped = {name for name, left in seen["rayleigh"].items() if left == pytest.approx(DECAY, rel=0.01)}
    undamped = {name for name, left in seen["rayleigh"].items() if left > 0.999}
    assert undamped == {"zeroLength", "twoNodeLink", "truss", "corotTruss"}
    assert damped == {
        *("elasticBeamColumn", "forceBeamColumn", "dispBeamColumn", "zeroLengthSection"),
        *("zeroLength -doRayleigh 1", "truss -doRayleigh 1", "twoNodeLink -doRayleigh"),
        *("twoNodeLink -doRayleigh 0", "elasticBeamColumn -doRayleigh 0"),  # the 0 is ignored
    }


def test_a_recorder_starts_at_the_end_of_the_first_step_and_its_interval_is_whole_steps(seen: dict[str, Any]) -> None:
    assert times(seen, "every")[0] == 0.001
    assert times(seen, "multiple").tolist() == [0.001, 0.011, 0.021, 0.031, 0.041]
    assert times(seen, "no_multiple").tolist() == [0.003, 0.015, 0.027, 0.039, 0.051]  # not 0.01 apart
    assert len(times(seen, "power_of_two")) == 182  # of 2000 steps of 1/1024 s: 195 rows would be 10 ms apart
    found, said = imported(seen, "power_of_two")
    assert found.dt == pytest.approx(11 / 1024, rel=2e-5) and said == ""  # six digits fix it to 1e-5
    assert found.start == pytest.approx(1 / 1024, abs=1e-6)


def test_six_digits_of_time_are_read_as_the_equal_steps_that_they_were(seen: dict[str, Any]) -> None:
    assert "99.002" in {row[0] for row in seen["recorder"]["after_100"]}
    assert len(set(times(seen, "after_1000"))) < 335  # of 600 steps of 1 ms
    for name, step, last in (("after_100", 1 / 1024, 99 + 3000 / 1024), ("after_1000", 0.001, 1000.3)):
        found, said = imported(seen, name)
        assert found.dt == pytest.approx(step, rel=1e-9)
        assert found.time[-1] == pytest.approx(last, abs=6e-4)
        assert "equal steps were recovered" in said and "-precision 16" in said
        values = [float(row[1]) for row in seen["recorder"][name]]
        assert found.get("x_meas", 1).tolist() == values
    assert imported(seen, "sixteen_digits")[1] == ""


def test_imposed_motion_needs_other_constraints_than_plain_and_displacements(seen: dict[str, Any]) -> None:
    plain, disp, accel, short = (seen["imposed"][name] for name in ("plain", "disp", "accel", "accel_short"))
    assert set(plain["moved"]) == {0.0} and "homogeneous constraint assumed" in plain["said"]
    assert disp["moved"] == pytest.approx(disp["wanted"], abs=1e-12) and disp["said"] == ""
    assert accel["moved"][:199] == pytest.approx(accel["wanted"][:199], abs=1e-5)
    assert set(accel["moved"][199:]) == {0.0}  # the last 0.5 of 2.5 s
    assert set(short["moved"]) == {0.0}  # all of 0.8 s


def test_maxwell_counts_with_its_whole_spring_in_eigenvalues(seen: dict[str, Any]) -> None:
    assert seen["maxwell"]["Maxwell"] == pytest.approx([4 * OMEGA**2] * 2)  # whatever its dashpot
    assert seen["maxwell"]["ViscousDamper"] == pytest.approx([OMEGA**2] * 2)


def test_eigenvalues_beside_massless_degrees_of_freedom(seen: dict[str, Any]) -> None:
    """A chain of 20 springs, ten nodes with mass."""
    found, (all_ten, eleven), (nine, ten) = (seen["massless"][name] for name in ("default", "lapack", "none_massless"))
    assert [one is not None for one in found] == [True] * 5 + [False] * 5
    assert found[4] == pytest.approx(all_ten[:5])
    assert len(all_ten) == 10 and all_ten[-1] < 4000
    assert eleven[-1] == np.finfo(float).max
    assert len(nine) == 9 and ten is None
