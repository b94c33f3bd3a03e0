"""`rths run` at a terminal: its progress bar, and Ctrl-C."""

from __future__ import annotations

import json
import os
import pty
import re
import signal
import subprocess
import sys
import termios
from pathlib import Path

from rths_engine.planning import templates
from rths_engine.planning.plan import RealTime
from rths_engine.planning.reading import plan_to_yaml
from rths_engine.recordings.run_file import load

RTHS = [sys.executable, "-m", "app.cli"]


def plan(**changes: object) -> str:
    return plan_to_yaml(templates.template("two-storeys").model_copy(update=changes))


def until_shown(terminal: int, pattern: str) -> None:
    """Read what a program writes to its terminal until `pattern` is there; fails when it ends without."""
    shown = ""
    while not re.search(pattern, shown):
        try:
            shown += os.read(terminal, 4096).decode()
        except OSError as error:
            raise AssertionError(f"no '{pattern}' in: {shown}") from error


def test_ctrl_c_keeps_what_was_recorded(tmp_path: Path) -> None:
    (tmp_path / "plan.yaml").write_text(plan(pace=RealTime()))
    command = [*RTHS, "run", str(tmp_path / "plan.yaml"), "--out", str(tmp_path / "rec.h5"), "--json"]
    terminal, its_side = pty.openpty()
    termios.tcsetwinsize(terminal, (24, 100))
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=its_side, text=True) as running:
        os.close(its_side)
        until_shown(terminal, r"[1-9] of 40\.0 s simulated")
        running.send_signal(signal.SIGINT)
        out, _ = running.communicate()
    os.close(terminal)
    found = json.loads(out)
    assert running.returncode == 130 and found["status"] == "cancelled"
    assert 0.0 < found["simulated_s"] < 40.0
    recording = load(tmp_path / "rec.h5")
    assert recording.status == "cancelled" and len(recording.signals) < recording.total
    assert recording.summary == found


def test_a_plan_is_read_from_standard_input_and_no_bar_is_drawn_without_a_terminal() -> None:
    made = subprocess.run([*RTHS, "run", "-", "--json"], input=plan(duration=0.5), capture_output=True, text=True, check=True)
    assert json.loads(made.stdout)["status"] == "completed" and not made.stderr
