"""What a worker sends over its websocket, checked before any part of it is used: a malformed message closes the connection."""

from __future__ import annotations

import json
import struct
from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

FRAME_HEADER = struct.Struct("<36sI")  # run id, attempt
MOST_ATTEMPTS = 2**32 - 1  # of FRAME_HEADER

RunId = Annotated[str, Field(min_length=1, max_length=36)]
Id = Annotated[str, Field(min_length=1, max_length=200)]
Number = Annotated[float, Field(allow_inf_nan=False)]


class BadMessage(ValueError):
    """A message that does not follow the protocol of workers; its text says what is wrong, in few words."""


def _with_zone(text: str) -> str:
    if datetime.fromisoformat(text).tzinfo is None:
        raise ValueError("needs a time zone")
    return text


class _Message(BaseModel):
    """A message of a worker. A worker of a later version may send more fields."""

    model_config = ConfigDict(strict=True, extra="allow")


class _Press(_Message):
    id: Id
    by: str
    at: Annotated[str, AfterValidator(_with_zone)]


class _Latch(_Message):
    presses: list[_Press]
    released: list[Id]


class Hello(_Message):
    """What a worker says of itself: its name, its latch, and the tests that its engines execute."""

    worker: str
    latch: _Latch
    acknowledged: list[Id]
    stopping: list[str]


class _Executed(_Message):
    kind: Id
    id: RunId
    attempt: Annotated[int, Field(ge=0, le=MOST_ATTEMPTS)]


class Question(_Message):
    """What a worker asks that does not reach the database: to be known to live, and which of its jobs are to stop."""

    number: int
    tests_at_a_time: Annotated[int, Field(ge=1, le=1000)]
    executing: Annotated[list[_Executed], Field(max_length=1000)]


class Contact(_Message):
    """The question of a worker that is cut off from the database."""

    contact: Question


class _Channel(_Message):
    key: str


class _Schema(_Message):
    type: Literal["schema"]
    attempt: int
    dt: Annotated[float, Field(gt=0, allow_inf_nan=False)]
    bucket: Annotated[int, Field(ge=1)]
    buckets: Annotated[int, Field(ge=0)]
    channels: Annotated[list[_Channel], Field(min_length=1, max_length=10_000)]


class _Progress(_Message):
    type: Literal["progress"]
    state: str
    simulated_s: Number
    elapsed_s: Number
    duration_s: Number


class _End(_Message):
    type: Literal["end"]


class Told(_Message):
    """A message of the execution of a run, for its viewers."""

    run_id: RunId
    attempt: Annotated[int, Field(ge=0, le=MOST_ATTEMPTS)]
    message: Annotated[_Schema | _Progress | _End, Field(discriminator="type")]


_HELLO, _CONTACT, _TOLD = TypeAdapter(Hello), TypeAdapter(Contact), TypeAdapter(Told)


def message(text: str) -> dict[str, Any]:
    """A text message, with the key `worker` or `contact`, or as `Told`. Raises BadMessage."""
    try:
        sent = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise BadMessage(f"is not valid JSON ({type(error).__name__})") from None
    if not isinstance(sent, dict):
        raise BadMessage("is not a JSON object")
    try:
        (_HELLO if "worker" in sent else _CONTACT if "contact" in sent else _TOLD).validate_python(sent)
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        raise BadMessage(f"{'.'.join(map(str, first['loc']))[:60]}: {first['msg'][:60]}") from None
    return sent


def frame(content: bytes) -> tuple[str, int, bytes]:
    """Run id, attempt and buckets of a binary message. Raises BadMessage."""
    if len(content) < FRAME_HEADER.size:
        raise BadMessage(f"has {len(content)} bytes; the header of a frame has {FRAME_HEADER.size}")
    run_id, attempt = FRAME_HEADER.unpack_from(content)
    try:
        return run_id.decode("ascii"), attempt, content[FRAME_HEADER.size :]
    except UnicodeDecodeError:
        raise BadMessage("its run id is not text") from None
