"""Live frames: what is kept of each bucket, and that any chunks give the same bytes."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from app.live.frames import HEADER, MOST_BUCKETS, MOST_OPEN, Decimator, FrameStore, bucket_size
from app.live.hub import Hub
from rths_engine.results.channels import Channel

CHANNELS = (Channel("x_cmd", 1, "A"), Channel("d_alpha", 1, "B"))
SENT = 3  # both, and the command velocity
DT = 1 / 1024


def unpacked(frame: bytes) -> tuple[int, np.ndarray]:
    first, count = HEADER.unpack_from(frame)
    return first, np.frombuffer(frame, "<f4", offset=HEADER.size).reshape(count, SENT, 3)


@given(
    total=st.integers(1, 400), bucket=st.integers(1, 9), cuts=st.lists(st.integers(0, 400), max_size=8), seed=st.integers(0, 99)
)
def test_each_bucket_keeps_its_minimum_maximum_and_last_sample_however_it_comes(
    total: int, bucket: int, cuts: list[int], seed: int
) -> None:
    signals = np.random.default_rng(seed).normal(size=(total, 2))
    decimator, store = Decimator(CHANNELS, bucket, DT), FrameStore(SENT)
    for done in [*sorted(cut for cut in cuts if cut < total), total]:
        frame = decimator.frame(signals, done, ended=done == total)
        assert frame is None or store.append(frame)
    whole = store.since(0)
    assert whole is not None
    first, values = unpacked(whole)
    assert first == 0 and len(values) == -(-total // bucket)
    velocity = np.diff(signals[:, 0], prepend=0.0) / DT  # as the safety check takes it
    every = np.column_stack([signals, velocity]) / [1e-3, 1.0, 1e-3]
    for k, got in enumerate(values):
        part = every[k * bucket : (k + 1) * bucket]
        expected = np.stack([part.min(axis=0), part.max(axis=0), part[-1]], axis=1)
        assert np.array_equal(got, expected.astype("<f4"))


@given(total=st.integers(1, 50_000_000))
def test_a_run_of_any_length_has_a_bounded_number_of_buckets(total: int) -> None:
    assert -(-total // bucket_size(total)) <= MOST_BUCKETS
    assert -(-total // bucket_size(total, open_ended=True)) <= MOST_OPEN


def test_ten_seconds_of_a_test_that_a_client_ends_are_no_staircase() -> None:
    assert bucket_size(600 * 1024, open_ended=True) * DT <= 0.01


def test_a_store_ignores_what_it_has_and_refuses_gaps_and_rubbish() -> None:
    signals = np.arange(40.0).reshape(20, 2)
    store = FrameStore(SENT)
    whole = Decimator(CHANNELS, 1, DT).frame(signals, 20)
    early = Decimator(CHANNELS, 1, DT).frame(signals, 5)
    assert whole is not None and early is not None
    assert store.append(early) and store.append(early) and store.append(whole)
    assert store.since(0) == whole
    assert store.since(20) is None
    tail = store.since(17)
    assert tail is not None and not FrameStore(SENT).append(tail)
    assert not store.append(whole[:-1]) and not store.append(b"") and store.count == 20


def test_the_hub_begins_anew_with_a_new_attempt_and_ignores_the_old_one() -> None:
    hub = Hub()
    schema = {"type": "schema", "channels": [{}] * SENT}
    frame = Decimator(CHANNELS, 1, DT).frame(np.ones((4, 2)), 4)
    assert frame is not None
    hub.take("run", 1, schema)
    hub.frame("run", 1, frame)
    first = hub.runs["run"]
    assert first.store.count == 4
    hub.take("run", 1, schema)  # told again after a lost connection
    assert hub.runs["run"] is first
    hub.take("run", 2, schema)
    hub.frame("run", 1, frame)
    hub.take("run", 1, {"type": "progress"})
    hub.take("run", 1, {"type": "end"})  # of a worker taken for dead
    assert hub.runs["run"].store.count == 0 and hub.runs["run"].progress is None
    hub.take("run", 2, {"type": "end"})
    assert "run" not in hub.runs
