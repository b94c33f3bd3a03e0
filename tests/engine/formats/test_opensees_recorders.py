"""Recorders of OpenSees and OpenFresco: names where XML states them, no unit and no time where the file states none."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.registry import RECORD
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers import opensees

ROWS = [(0.01 * k, 0.5 * k, -0.25 * k) for k in range(1, 13)]
UNITLESS = "OpenSees states no units: give the unit of time and of every column"


def read(content: bytes, name: str) -> Table:
    return registry.read(Source(name, content=content))


def refusal(content: bytes, name: str) -> str:
    with pytest.raises(FileError) as refused:
        read(content, name)
    return str(refused.value)


def matrix(table: Table) -> np.ndarray:
    return np.column_stack([one.values for one in table.columns])


def test_xml_names_every_column_and_states_no_unit() -> None:
    table = read(opensees.xml(ROWS, (2, 3)), "node.xml")
    assert [(one.name, one.unit, one.dt, one.quantity) for one in table.columns] == [
        ("time", "", None, "time"),
        ("node 2 D1", "", None, "displacement"),
        ("node 3 D1", "", None, "displacement"),
    ]
    np.testing.assert_allclose(matrix(table), ROWS, rtol=1e-12)
    assert table.notes == (UNITLESS,)


def test_responses_of_materials_inside_elements_are_told_apart() -> None:
    inside = '<UniaxialMaterialOutput matType="Steel01" matTag="7"><ResponseType>sig11</ResponseType></UniaxialMaterialOutput>'
    one = '<ElementOutput eleType="ZeroLength" eleTag="{0}" node1="1" node2="2">' + inside + "</ElementOutput>"
    content = (
        f'<?xml version="1.0"?>\n<OpenFresco>\n{one.format(1)}\n{one.format(2)}\n<Data>\n1 2\n3 4\n</Data>\n</OpenFresco>\n'
    )
    table = read(content.encode(), "a.xml")
    assert list(table.names) == ["element 1 uniaxial material 7 sig11", "element 2 uniaxial material 7 sig11"]
    assert matrix(table).tolist() == [[1, 2], [3, 4]]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("0.03 1.5 -0.75", "0.03 1.5", "line 17 = 0.03 1.5: has 2 fields; 3 are expected"),
        ("0.03 1.5 -0.75", "0.03 1.5 -0.75 4", "has 4 fields; 3 are expected"),
        ("0.03 1.5 -0.75", "0.03 1.5 -0.7.5", "line 17 = -0.7.5: column node 3 D1 is not a number"),
        ("        </Data>\n</OpenSees>\n", "", "the last row can be cut"),
        ("<TimeOutput>", "<TimeOutput", "is not valid XML before its rows"),
        ("<OpenSees\n", '<!DOCTYPE a [<!ENTITY b "c">]>\n<OpenSees\n', "has declarations in its XML text"),
    ],
)
def test_damaged_xml_is_refused(old: str, new: str, told: str) -> None:
    text = opensees.xml(ROWS, (2, 3)).decode()
    assert old in text
    assert told in refusal(text.replace(old, new, 1).encode(), "node.xml")


def test_text_has_no_names_units_or_step() -> None:
    table = read(opensees.text(ROWS), "disp.out")
    assert table.format == "OpenSees recorder (text)" and not table.named and UNITLESS in table.notes
    assert [(one.name, one.unit, one.dt) for one in table.columns] == [(f"column {k}", "", None) for k in (1, 2, 3)]
    np.testing.assert_allclose(matrix(table), ROWS, rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("Control_daqFrc.out", ["column 1", "measured force 1 (daqFrc)", "measured force 2 (daqFrc)"]),
        ("Control_ctrlDsp.out", ["column 1", "command displacement 1 (ctrlDsp)", "command displacement 2 (ctrlDsp)"]),
    ],
)
def test_responses_of_openfresco_are_read_from_the_name_of_the_file_and_marked(name: str, names: list[str]) -> None:
    table = read(opensees.text(ROWS), name)
    assert [one.name for one in table.columns] == names
    assert "is from the name of the file, which the file does not confirm" in table.notes[-1]


def test_an_envelope_is_refused_as_such() -> None:
    rows = [(2.14, -0.03, 3.47, -0.0561625), (0.53, 0.0301827, 0.54, 0.0553382), (0.53, 0.0301827, 3.47, 0.0561625)]
    assert "not a time history" in refusal(opensees.text(rows), "env.out")
    assert "not a time history" in refusal(opensees.text([row[1::2] for row in rows]), "env.out")
    assert len(read(opensees.text(ROWS[:3]), "disp.out").columns) == 3


def test_cut_rows_are_refused_with_the_line() -> None:
    text = opensees.text(ROWS).decode()
    assert "line 3 = 0.03 1: has 2 fields; 3 are expected" in refusal(
        text.replace("0.03 1.5 -0.75", "0.03 1").encode(), "a.out"
    )
    assert "line 1 = 5 -0.25: has 2 fields" in refusal(text.removeprefix("0.01 0.").encode(), "a.out")
    assert "31892.6.68" in refusal(text.replace("1.5", "31892.6.68", 1).encode(), "a.out")


def test_a_ground_motion_that_ends_with_out_stays_a_record() -> None:
    source = Source("record.out", content=opensees.text([(row[1],) for row in ROWS]))
    assert registry.detected(source, RECORD) is RECORD


def test_binary_rows_end_with_a_line_feed() -> None:
    table = read(opensees.binary(ROWS), "disp.bin")
    assert table.format == "OpenSees recorder (binary)" and not table.named
    assert matrix(table).tolist() == [list(row) for row in ROWS]
    with pytest.raises(FileError):
        read(opensees.binary(ROWS)[:-1], "disp.bin")


value = st.floats(-1e6, 1e6).map(lambda one: float(f"{one:.6g}"))


@given(st.integers(1, 5), st.integers(8, 20), st.data())
def test_any_recorder_comes_back(width: int, count: int, data: st.DataObject) -> None:
    row = st.tuples(*[value] * width)
    rows = [(0.5 * k, *data.draw(row)) for k in range(1, count + 1)]
    assert matrix(read(opensees.text(rows), "a.out")).tolist() == [list(one) for one in rows]
    assert matrix(read(opensees.binary(rows), "a.bin")).tolist() == [list(one) for one in rows]
    table = read(opensees.xml(rows, range(1, width + 1), response="A"), "a.xml")
    assert matrix(table).tolist() == [list(one) for one in rows]
    assert [one.name for one in table.columns] == ["time", *(f"node {k} A1" for k in range(1, width + 1))]


@given(
    st.sampled_from(
        [
            ("a.out", "opensees-text", opensees.text(ROWS)),
            ("a.xml", "opensees-xml", opensees.xml(ROWS, (2, 3))),
            ("a.bin", "opensees-binary", opensees.binary(ROWS)),
        ]
    ),
    st.integers(1, 1500),
    st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 255)), max_size=5),
)
def test_a_damaged_or_cut_file_is_read_or_refused(
    made: tuple[str, str, bytes], cut: int, changes: list[tuple[int, int]]
) -> None:
    name, key, content = made
    damaged = bytearray(content[:cut])
    for at, byte in changes:
        damaged[at % len(damaged)] = byte
    try:
        registry.read(Source(name, content=bytes(damaged)), format=key)
    except FileError as refused:
        assert refused.issues
