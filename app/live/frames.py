"""Live frames: minimum, maximum and last sample of every channel in each bucket of substeps, float32, in the units shown.

The command velocity of each station follows the recorded channels: its limit is checked in every controller step, and a
viewer cannot derive its peak from buckets. A frame is little-endian: `uint32 first_bucket, uint32 count`, then float32
`[count][channels][3]`. A `FrameStore` is the buffer of a run. It takes frames of any size, ignores buckets that it already has,
and gives a reader the missing buckets in frames of at most PIECE bytes of values, or of one bucket.
"""

from __future__ import annotations

import struct

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.results.channels import CHANNELS, Channel, columns

HEADER = struct.Struct("<II")
MOST_BUCKETS = 16_384
MOST_OPEN = 65_536
"""Buckets of a run that may end long before its longest duration. A viewer of 20 channels stores 16 MB."""
PIECE = 1 << 20
"""Bytes of values in the longest frame that is sent at once: so much may wait in memory for each receiver that reads slowly."""
VALUES = 3  # minimum, maximum, last


def bucket_size(total: int, open_ended: bool = False) -> int:
    """Number of substeps in a bucket, so that a run of `total` substeps has at most MOST_BUCKETS buckets.

    An open-ended run has at most MOST_OPEN: 10 s of a test of at most 600 s are then a thousand buckets, and no staircase.
    """
    return max(1, -(-total // (MOST_OPEN if open_ended else MOST_BUCKETS)))


class Decimator:
    """Makes frames from the growing signals of a run, sampled every `dt` (s). `channels`: those of its frames."""

    def __init__(self, recorded: tuple[Channel, ...], bucket: int, dt: float):
        self.bucket, self.sent, self.dt = bucket, 0, dt
        self._commands = columns(recorded, "x_cmd")
        self.channels = (*recorded, *(_velocity(recorded[column].number) for column in self._commands))
        self._factors = np.array([channel.factor for channel in self.channels])

    def frame(self, signals: Array, done: int, ended: bool = False) -> bytes | None:
        """The buckets completed by rows [:done] since the last call; with `ended`, also the last, partial bucket."""
        first = self.sent * self.bucket
        whole = (done // self.bucket) * self.bucket
        rows = self._with_velocities(signals, first, done if ended else whole)
        parts = [_extremes(rows[: whole - first].reshape(-1, self.bucket, rows.shape[1]))] if whole > first else []
        if ended and done > whole:
            parts.append(_extremes(rows[None, max(whole - first, 0) :]))
        if not parts:
            return None
        values = (np.concatenate(parts) / self._factors[:, None]).astype("<f4")
        frame: bytes = HEADER.pack(self.sent, len(values)) + values.tobytes()
        self.sent += len(values)
        return frame

    def _with_velocities(self, signals: Array, first: int, end: int) -> Array:
        """Rows [first:end] with the command velocity of each station, as the safety check computes it; d_c starts at 0."""
        if end <= first:
            return np.empty((0, len(self.channels)))
        commands = signals[max(0, first - 1) : end, self._commands]
        before = commands[:-1] if first else np.vstack([np.zeros((1, len(self._commands))), commands[:-1]])
        with np.errstate(over="ignore", invalid="ignore"):
            velocities = (commands[-(end - first) :] - before) / self.dt
        return np.hstack([signals[first:end], velocities])


class FrameStore:
    """All buckets of one attempt of a run, in order."""

    def __init__(self, channels: int):
        self.row = channels * VALUES * 4
        self._data = bytearray()

    @property
    def count(self) -> int:
        return len(self._data) // self.row

    def append(self, frame: bytes) -> bool:
        """Add a frame, without the buckets already stored. False if earlier buckets are missing or the frame is malformed."""
        if len(frame) < HEADER.size:
            return False
        first, count = HEADER.unpack_from(frame)
        if first > self.count or len(frame) != HEADER.size + count * self.row or first + count > MOST_OPEN:
            return False
        self._data += frame[HEADER.size + (self.count - first) * self.row :]
        return True

    def values(self) -> Array:
        """All buckets, (buckets, channels, 3): minimum, maximum and last sample of each channel, in the units shown."""
        return np.frombuffer(bytes(self._data), "<f4").reshape(-1, self.row // (4 * VALUES), VALUES)

    def since(self, first: int) -> bytes | None:
        """The buckets from `first` on as one frame, as many as it may have, or None if there are none."""
        first = max(0, first)
        end = min(self.count, first + max(1, PIECE // self.row))  # once: another thread may be appending
        if first >= end:
            return None
        return HEADER.pack(first, end - first) + bytes(self._data[first * self.row : end * self.row])


def end_of(frame: bytes) -> int:
    """The bucket that follows a frame."""
    first, count = HEADER.unpack_from(frame)
    return int(first + count)


def _velocity(station: int | None) -> Channel:
    return Channel("v_cmd", station, CHANNELS["v_cmd"].label)


def _extremes(buckets: Array) -> Array:
    """(buckets, channels, 3) from (buckets, samples, channels)."""
    return np.stack([buckets.min(axis=1), buckets.max(axis=1), buckets[:, -1]], axis=-1)
