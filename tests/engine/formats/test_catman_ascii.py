"""catman ASCII exports: names, units and a time channel for each rate; the mark of a missing sensor is no measurement."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers.catman_ascii import written

TIMES = [0.0, 0.02, 0.04, 0.06]
FORCE, TEMPERATURE = ("Kraft", "N", [122.99, 123.5, -1.0, 0.25]), ("Pyrometer", "°C", [20.5, 20.75])
OFF = ("Drehwinkel", "V", [-1e6] * 4)
FAST, SLOW = ("Standardmessrate", TIMES, [FORCE, OFF]), ("langsam", [0.0, 0.5], [TEMPERATURE])


def read(content: bytes) -> Table:
    return registry.read(Source("test.asc", content=content))


@pytest.mark.parametrize("decimal", [".", ","])
def test_channels_of_each_rate_have_its_time_channel(decimal: str) -> None:
    table = read(written([FAST, SLOW], decimal))
    assert table.format == "catman ASCII" and table.notes == ("Drehwinkel holds no measurements",)
    fast, slow = "Zeit 1 - Standardmessrate", "Zeit 2 - langsam"
    assert [(one.name, one.unit, one.time) for one in table.columns] == [
        (fast, "s", ""),
        ("Kraft", "N", fast),
        (slow, "s", ""),
        ("Pyrometer", "°C", slow),
    ]
    assert [one.values.tolist() for one in table.columns] == [TIMES, FORCE[2], [0.0, 0.5], TEMPERATURE[2]]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("123.500000", "-1000000", "line 3: Kraft is out of range: catman writes -1000000 for it (1 values)"),
        ("123.500000", "********", "line 3 = ********: column Kraft [N] is not a number"),
        ("123.500000", "123,500000", "line 3 = 123,500000: column Kraft [N] is not a number"),
        ("123.500000", "", "line 3: column Kraft is empty between its values"),
        ("123.500000\t", "", "line 3"),
    ],
)
def test_a_row_that_does_not_fit_is_refused(old: str, new: str, told: str) -> None:
    text = written([("Standardmessrate", TIMES, [FORCE])]).decode("cp1252")
    assert old in text
    with pytest.raises(FileError) as refused:
        read(text.replace(old, new, 1).encode("cp1252"))
    assert told in str(refused.value)


value = st.floats(-9e5, 9e5).map(lambda one: float(f"{one:.6f}"))


@given(
    st.lists(st.text("abcXYZ_012", min_size=1, max_size=8), min_size=1, max_size=4, unique=True),
    st.lists(value, min_size=2, max_size=12),
    st.sampled_from([".", ","]),
)
def test_any_file_comes_back(names: list[str], values: list[float], decimal: str) -> None:
    times = [0.5 * k for k in range(len(values))]
    table = read(written([("schnell", times, [(name, "kN", values) for name in names])], decimal))
    assert [one.name for one in table.columns[1:]] == names
    assert all(one.values.tolist() == values and one.unit == "kN" for one in table.columns[1:])


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"MULTI_STREAM_FILE_VER02105" + bytes(40), "is a Dewesoft file (.dxd, .d7d)"),
        (b"FORMAT\0" + bytes(200), "is an RPC III file"),
        (b'"TOB1","a","CR6"\r\n' + bytes(20), "convert it with CardConvert to TOA5"),
        (b'"TOACI1","a","t"\r\n"TMSTAMP","x"\r\n"2024-01-01 00:00:00",1\r\n', "export it as TOA5"),
        (b'<?xml version="1.0"?>\n<usi:tdm xmlns:usi="x" version="1.0">\n', "save it in DIAdem as TDMS or CSV"),
    ],
)
def test_files_of_other_loggers_are_named(content: bytes, told: str) -> None:
    with pytest.raises(FileError) as refused:
        read(content)
    assert told in str(refused.value)
