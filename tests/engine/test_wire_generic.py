import math
import struct

from rths_engine.wire import generic
from rths_engine.wire.generic import Action, Numbers, Request, Sizes


def test_the_setup_message_of_openseespy_is_read_and_written_unchanged() -> None:
    seen = struct.pack("<11i", 1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 256)  # of an element with one degree of freedom
    found = generic.unpack_sizes(seen)
    assert found == Sizes(Numbers(1, 1, 1, 0, 1), Numbers(force=1), 256)
    assert generic.pack_sizes(found) == seen and len(seen) == generic.SETUP_BYTES


def test_a_request_is_action_vectors_and_time_followed_by_zeros() -> None:
    request = Request(Action.SET_TRIAL, (0.1, 0.2), (1.0, 2.0), (10.0, 20.0), 0.5)
    data = generic.pack_request(request, generic.smallest_size(2) + 3)
    assert struct.unpack("<11d", data) == (3.0, 0.1, 0.2, 1.0, 2.0, 10.0, 20.0, 0.5, 0.0, 0.0, 0.0)
    assert generic.unpack_request(data, Numbers(2, 2, 2, 0, 1)) == request


def test_a_code_that_is_no_number_is_no_action() -> None:
    for value in (math.nan, math.inf, -math.inf):
        data = struct.pack("<5d", value, 0, 0, 0, 0)
        assert generic.unpack_request(data, Numbers(1, 1, 1, 0, 1)).action == -1


def test_replies_hold_their_values_first_and_long_messages_are_cut_for_udp() -> None:
    data = generic.pack_values((1.5, -2.5), 2000)
    assert generic.unpack_values(data, 2) == (1.5, -2.5) and len(data) == 16_000
    parts = generic.datagrams(data)
    assert [len(part) for part in parts] == [generic.DATAGRAM, 16_000 - generic.DATAGRAM] and b"".join(parts) == data


def test_only_requests_for_values_are_answered() -> None:
    unanswered = {Action.OPEN, Action.SETUP, Action.SET_TRIAL, Action.EXECUTE, Action.COMMIT, Action.END}
    assert set(Action) - unanswered == {action for action in Action if action in generic.ANSWERED}
