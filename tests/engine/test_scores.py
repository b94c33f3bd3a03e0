"""Published scores: recognised by content, refused a rank on another split, and right on made data."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from app.cli.main import main
from rths_engine.scores import friction, oscillator, positioning
from rths_engine.scores.score import Entry, pooled_error, rms_error


def test_errors_are_those_of_their_definitions() -> None:
    one, two = np.array([3.0, 4.0]), np.array([0.0, 12.0])
    assert rms_error(one, one - 2.0) == pytest.approx(2.0)
    assert pooled_error([(one, 0 * one), (two, two)]) == pytest.approx(5 / 13)  # sqrt(25 / 169)


def test_a_score_is_ranked_only_on_the_published_split() -> None:
    ours = [Entry("ours", 0.04)]
    full = positioning.SCORE.scored(ours, positioning.SCORE.split)
    assert [one.error for one in full.ranking()] == [0.039, 0.04, 0.046]
    assert positioning.SCORE.scored(ours, "another", ["DATA_EMPS_PULSES.mat"]).ranking() == []


def test_a_folder_without_the_data_sets_is_told_what_it_lacks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "notes.json").write_text("[1, 2]")
    savemat(tmp_path / "short.mat", {"V1": np.zeros(9), "V2": np.zeros(9)})
    assert main(["scores", str(tmp_path), "--json", str(tmp_path / "out.json")]) == 0
    said = capsys.readouterr().out
    assert "SNLS80mV.mat with 131072 samples (short.mat has 9)" in said
    assert "DATA_EMPS.mat, DATA_EMPS_PULSES.mat; published at nonlinearbenchmark.org" in said
    found = json.loads((tmp_path / "out.json").read_text())["scores"]
    assert [one["name"] for one in found] == ["silverbox", "emps", "brfd"]
    assert all(one["ours"] == [] and one["ranked"] is False and one["ranking"] == [] for one in found)
    assert main(["scores", str(tmp_path / "nowhere")]) == 2


def test_a_carriage_with_known_friction_is_scored_on_the_record_with_pulses(tmp_path: Path) -> None:
    """f = m a + c v + F_c sign(v) + o: the second law holds it, and its error is the noise, 0.3 %."""
    time = np.arange(6000) / 1000.0
    for name, f, seed in (("DATA_EMPS", 0.7, 1), ("DATA_EMPS_PULSES", 1.1, 2)):
        w = 2 * np.pi * f
        x, v, a = 0.1 * np.sin(w * time), 0.1 * w * np.cos(w * time), -0.1 * w * w * np.sin(w * time)
        force = 95.0 * a + 200.0 * v + 20.0 * np.sign(v) - 3.0
        force += np.random.default_rng(seed).normal(0.0, 1.0, len(time))
        held = {"qm": x, "qg": x, "vir": force / 35.0, "gtau": np.array([35.0]), "t": time}
        savemat(tmp_path / f"{name}.mat", {key: value.reshape(-1, 1) for key, value in held.items()})
    found = positioning.score(tmp_path)
    plain, whole = (one.error for one in found.ours)
    assert found.ranked and len(found.ranking()) == 4
    assert plain > 3 * whole and whole < 0.01


def test_files_of_the_damper_are_read_in_their_units() -> None:
    held = {"data": [[0.0, 1.0, 2.0], [0.1, 0.0, 0.0]], "dt": 0.1, "displacement units": "in", "friction force units": "kip"}
    found = friction.data(held)
    assert found.x[0] == pytest.approx(0.0254) and found.force[0] == pytest.approx(2 * 4448.2216)


def test_a_made_oscillator_with_a_cubic_spring_is_scored_by_a_free_run() -> None:
    """u = (y'' + 2 zeta w y' + w^2 (y + k3 y^3)) / w^2 of a given motion y of some 50 Hz, so that no solver is needed."""
    count, rate, w = 1500, oscillator.RATE, 2 * np.pi * 68.0
    time = np.arange(count) / rate
    random = np.random.default_rng(0)
    y, v, a = (np.zeros(count) for _ in range(3))
    for f, phase in zip(np.linspace(20.0, 90.0, 24), random.uniform(0, 2 * np.pi, 24), strict=True):
        s = 2 * np.pi * f
        y += 0.02 * np.sin(s * time + phase)
        v += 0.02 * s * np.cos(s * time + phase)
        a -= 0.02 * s * s * np.sin(s * time + phase)
    u = (a + 2 * 0.05 * w * v) / w**2 + y + 8.0 * y**3
    linear, cubic = oscillator.errors(u, y, oscillator.Split(slice(500, 1500), slice(0, 500), 50))
    assert cubic.error < 0.3 * linear.error and cubic.error < 5.0  # mV, of a motion of 70 mV
