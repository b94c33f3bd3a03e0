"""One generated case: its plan, its recordings and its truth."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from tests.proof.generator.files import write_arrays, write_plan, write_recording
from tests.proof.generator.motion import Array


@dataclass
class Recorded:
    """One recording: the shown channels, and the noise-free channels that are sealed."""

    dt: float
    shown: dict[str, Array]
    quiet: dict[str, Array]
    start: float = 0.0


@dataclass
class Truth:
    """The concealed truth. `effects` have component, id, form and SI parameters, under names of the library if it has them."""

    kind: str
    level: str
    seed: int
    effects: list[dict[str, Any]]
    outside: str | None
    strength: float | None  # lambda against the refitted baseline, of the fitting recording
    baseline: dict[str, Any]  # the true numbers of the plan's models
    noise: dict[str, float]  # of the output: sigma, pole, share
    output: str  # the channel that lambda is of
    about: dict[str, Any] = field(default_factory=dict)


@dataclass
class Case:
    plan: dict[str, Any]
    fitting: Recorded
    heldout: Recorded
    truth: Truth

    def write(self, shown: Path, sealed: Path) -> None:
        """Write plan.yaml, fit.h5, heldout.h5 to `shown`, and truth.json and both noise-free recordings to `sealed`."""
        for folder in (shown, sealed):
            folder.mkdir(parents=True)
        write_plan(shown / "plan.yaml", self.plan)
        for name, one in (("fit.h5", self.fitting), ("heldout.h5", self.heldout)):
            write_recording(shown / name, self.truth.kind, one.dt, one.shown, one.start)
            write_arrays(sealed / name, one.quiet)
        (sealed / "truth.json").write_text(json.dumps(asdict(self.truth), indent=1) + "\n", encoding="utf-8")
