"""Archives of measurements: harmful archives are refused as a whole before anything is unpacked; limits are lowered here."""

from __future__ import annotations

import io
import stat
import struct
import zipfile

import pytest

from rths_engine.foundation.errors import MeasuredError
from rths_engine.recordings.batches import Archive, Limits
from rths_engine.recordings.batches.archive import SMALL
from tests.engine import batch_files as made


def archive(raw: bytes, limits: Limits | None = None) -> Archive:
    return Archive(io.BytesIO(raw), "tests.zip", limits)


def packed(**files: bytes) -> bytes:
    return made.zipped({name.replace("_", "."): raw for name, raw in files.items()})


def with_entry(entry: zipfile.ZipInfo, content: bytes = b"a") -> bytes:
    raw = io.BytesIO()
    with zipfile.ZipFile(raw, "w") as file:
        file.writestr("good.csv", b"1,2\n")
        file.writestr(entry, content)
    return raw.getvalue()


def link() -> bytes:
    entry = zipfile.ZipInfo("link.csv")
    entry.create_system = 3
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    return with_entry(entry, b"/etc/passwd")


def test_files_come_back_byte_by_byte_and_those_of_the_system_are_left_out() -> None:
    files = {"day 1/b.csv": b"2", "day 1/a.csv": b"1" * 100_000}
    system = {"__MACOSX/day 1/._a.csv": b"x", ".DS_Store": b"x", "day 1/Thumbs.db": b"x"}
    opened = archive(made.zipped({**files, **system}))
    assert opened.names == ["day 1/a.csv", "day 1/b.csv"]
    for name, content in files.items():
        with opened.open(name) as stream:
            assert b"".join(iter(lambda: stream.read(7_000), b"")) == content
    opened.close()


@pytest.mark.parametrize(
    ("raw", "limits", "told"),
    [
        (made.zipped({f"{k}.csv": b"1" for k in range(4)}), Limits(files=3), "contains more than 3 files"),
        (made.zipped({f"{k}.csv": b"1" for k in range(90)}), Limits(files=3), "contains more than 3 files"),
        (
            made.zipped({"a.csv": bytes(3000), "b.csv": bytes(3000)}),
            Limits(bytes=5000),
            "0.006 MB: unpacks to more than 0.005 MB",
        ),
        (made.zipped({"a.csv": bytes(SMALL + 1)}), Limits(ratio=100), "more than 100 times its packed size"),
        (made.zipped({"../a.csv": b"1"}), None, "leads out of the archive"),
        (made.zipped({"a/../../a.csv": b"1"}), None, "leads out of the archive"),
        (made.zipped({"/etc/a.csv": b"1"}), None, "leads out of the archive"),
        (made.zipped({"C:/a.csv": b"1"}), None, "leads out of the archive"),
        (made.zipped({"..\\a.csv": b"1"}), None, "leads out of the archive"),
        (link(), None, "contains a link"),
        (made.zipped({}), None, "contains no file"),
        (made.zipped({".hidden": b"1"}), None, "contains no file"),
        (b"1,2\n3,4\n", None, "is not a complete ZIP archive"),
        (made.zipped({"a.csv": b"1" * 999})[:-30], None, "is not a complete ZIP archive"),
        (b"", None, "is not a complete ZIP archive"),
    ],
    ids=range(15),  # not by their bytes, which hold the time of writing: each worker has to collect the same names
)
def test_an_archive_that_can_harm_is_refused_as_a_whole(raw: bytes, limits: Limits | None, told: str) -> None:
    with pytest.raises(MeasuredError) as refusal:
        archive(raw, limits)
    assert told in str(refusal.value) and str(refusal.value).startswith("tests.zip")


def test_two_files_of_one_name_are_refused() -> None:
    with pytest.warns(UserWarning, match="Duplicate name"):
        raw = with_entry(zipfile.ZipInfo("good.csv"))
    with pytest.raises(MeasuredError, match="two files of one name"):
        archive(raw)


def test_a_directory_that_is_too_large_is_refused_before_it_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """The end of the directory states its size; the entries themselves are not looked at."""
    monkeypatch.setattr(zipfile, "ZipFile", lambda *_: pytest.fail("the directory was read"))
    raw = b"PK\5\6" + struct.pack("<4H2LH", 0, 0, 1, 1, 10**9, 0, 0)
    for one in (raw, raw[:-2] + b"\4\0note"):
        with pytest.raises(MeasuredError, match="more than 1000 files"):
            archive(one)
    large = b"PK\6\6" + struct.pack("<Q2H2L4Q", 44, 45, 45, 0, 0, 1, 1, 10**12, 0)
    locator = b"PK\6\7" + struct.pack("<LQL", 0, 0, 1)
    with pytest.raises(MeasuredError, match="more than 1000 files"):
        archive(large + locator + b"PK\5\6" + struct.pack("<4H2LH", 0, 0, 1, 1, 46, 0, 0))


def test_a_damaged_and_an_encrypted_file_are_refused_alone() -> None:
    raw = bytearray(packed(a_csv=b"12345" * 50, b_csv=b"6789" * 50))
    raw[40] ^= 0xFF  # in the packed bytes of a.csv
    opened = archive(bytes(raw))
    with pytest.raises(MeasuredError, match="is damaged in the archive"), opened.open("a.csv") as stream:
        stream.read()
    with opened.open("b.csv") as stream:
        assert stream.read() == b"6789" * 50
    opened.close()
    secret = bytearray(packed(a_csv=b"1"))
    secret[6] |= 1
    secret[secret.index(b"PK\1\2") + 8] |= 1
    with pytest.raises(MeasuredError, match="is encrypted"), archive(bytes(secret)).open("a.csv"):
        pass


def test_an_entry_that_unpacks_to_more_than_it_states_is_refused() -> None:
    raw = bytearray(packed(a_csv=b"1" * 5000))
    raw[raw.index(b"PK\1\2") + 24 : raw.index(b"PK\1\2") + 28] = struct.pack("<L", 10)
    opened = archive(bytes(raw))
    with pytest.raises(MeasuredError, match="is damaged in the archive"), opened.open("a.csv") as stream:
        while stream.read(100):
            pass
    opened.close()
