"""What viewers see of a test while it runs: frames, and progress with the measures so far."""

from __future__ import annotations

from typing import Any

from app.live.frames import Decimator, bucket_size
from app.live.messages import progress, schema
from app.worker.child import Line


class Viewers:
    """Sends the frames and the progress of a run to its viewers. `elapsed` is the wall time of the last progress (s)."""

    open_ended = False
    """Whether the run may end long before its longest duration."""

    def __init__(self, run: Any, attempt: int, line: Line):
        from rths_engine.results.running import RunningMeasures

        self.run, self.line = run, line
        self.elapsed, self.measured = 0.0, 0
        self.measures = RunningMeasures(run.model, run.channels, run.history[0, 0])
        bucket = bucket_size(run.total, self.open_ended)
        self.decimator = Decimator(run.channels, bucket, run.dt)
        line.show(schema(attempt, run.dt, bucket, run.total, self.decimator.channels, self.open_ended))

    def tell(self, elapsed: float, ended: bool, **more: Any) -> None:
        """Send the new frames, and the progress after `elapsed` (s) of wall time with `more` in it."""
        self.elapsed = elapsed
        self.frame(ended)
        done, dt = self.run.done, self.run.dt
        self.measures.take(self.run.signals[self.measured : done])
        self.measured = done
        simulated, whole = done * dt, self.run.total * dt
        self.line.show(progress("running", simulated, elapsed, whole, self.measures.shown()) | more)
        least = "" if self.open_ended else f" of {whole:.1f} s"
        self.line.progress(f"at {simulated:.1f} s{least}", done / self.run.total)

    def frame(self, ended: bool) -> None:
        """Send the new frames."""
        frame = self.decimator.frame(self.run.signals, self.run.done, ended)
        if frame is not None:
            self.line.show(frame)
