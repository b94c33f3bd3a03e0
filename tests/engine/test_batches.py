"""Many files by one mapping: like files are imported, files that mean something else are refused, and the table says why."""

from __future__ import annotations

from collections.abc import Mapping as Texts
from functools import partial
from typing import Any

import numpy as np
import pytest

from rths_engine.recordings.batches import Batch, Item, Row, listing, run
from rths_engine.recordings.measured import Mapping, Measured, read
from tests.engine import batch_files as made


def imported(files: Texts[str, bytes], mapping: dict[str, Any], **more: Any) -> tuple[Batch, dict[str, Measured]]:
    """The batch, and the recordings of the files that it imported."""
    kept: dict[str, Measured] = {}
    items = [Item(name, len(raw), str(hash(raw)), partial(read, raw, name)) for name, raw in files.items()]
    batch = run(items, Mapping.read(mapping), lambda _, item, one: kept.update({item.name: one}), **more)
    return batch, {row.name: kept[row.name] for row in batch.rows if row.imported}


def row(batch: Batch, name: str) -> Row:
    return next(one for one in batch.rows if one.name == name)


def differences(batch: Batch, name: str) -> list[str]:
    return [f"{one.severity}: {one.text}" for one in row(batch, name).differences]


def reasons(batch: Batch, name: str) -> str:
    return "; ".join(map(str, row(batch, name).reasons))


def test_fifty_files_are_imported_or_refused_one_by_one_with_what_differs() -> None:
    batch, kept = imported(made.fifty(), made.mapping())
    refused = {one.name for one in batch.rows if not one.imported}
    assert refused == {"run11.csv", "run17.csv", "run31.csv"} and len(kept) == 47
    assert "the file does not have this column" in reasons(batch, "run11.csv")
    assert "error: unit of column 'Force (N)': N; in the other files kN" in differences(batch, "run11.csv")
    assert "error: column 'Force (kN)': missing; in the other files column 3" in differences(batch, "run17.csv")
    assert differences(batch, "run23.csv") == [
        "warning: sampling rate: 50 Hz; in the other files 100 Hz",
        "note: duration: 3.98 s; in the other files 1.99 s",
    ]
    assert row(batch, "run31.csv").reasons[0].where == "line 92"
    assert "order of columns" in differences(batch, "run37.csv")[0]
    assert any("largest value of f_meas.1" in one for one in differences(batch, "run41.csv"))
    assert "warning: signal of f_meas.1: constant; in the other files varies" in differences(batch, "run43.csv")
    assert "warning: content: the same as run02.csv; in the other files different" in differences(batch, "run47.csv")
    assert all(not one.differences for one in batch.rows if one.name not in made.DIFFERENT)


def test_each_recording_has_the_values_of_its_own_file() -> None:
    _, kept = imported(made.fifty(), made.mapping(title="Damper"))
    for name, measured in kept.items():
        kind, number = made.DIFFERENT.get(name), int(name[3:5])
        if kind in (None, "order", "rate"):
            truth = made.signals(number)
            np.testing.assert_allclose(measured.get("x_meas", 1), 1e-3 * truth["Disp (mm)"], rtol=1e-8, atol=1e-12)
            np.testing.assert_allclose(measured.get("f_meas", 1), 1e3 * truth["Force (kN)"], rtol=1e-8, atol=1e-9)
            assert measured.dt == pytest.approx(0.02 if kind == "rate" else 0.01)
        assert measured.title == f"Damper, {name.removesuffix('.csv')}"


def test_by_numbers_another_order_or_unit_is_refused() -> None:
    batch, kept = imported(made.fifty(), made.mapping(by_number=True))
    assert {one.name for one in batch.rows if not one.imported} == {"run11.csv", "run17.csv", "run31.csv", "run37.csv"}
    assert "the file states kN for column 'Force (kN)'; the mapping says mm" in reasons(batch, "run37.csv")
    assert any(one.startswith("error: order of columns: Time (s), Force") for one in differences(batch, "run37.csv"))
    assert "the file states N for column 'Force (N)'; the mapping says kN" in reasons(batch, "run11.csv")
    assert len(kept) == 46


def test_by_numbers_another_order_of_columns_without_units_is_refused() -> None:
    def bare(*order: str) -> bytes:
        return made.csv({head.partition(" ")[0]: made.signals(7)[head] for head in order})

    swapped = {"swapped.csv": bare("Time (s)", "Force (kN)", "Disp (mm)")}
    batch, kept = imported({**{f"{k}.csv": bare(*made.HEADS) for k in range(3)}, **swapped}, made.mapping(by_number=True))
    assert len(kept) == 3
    assert "order of columns, Time, Disp, Force there" in reasons(batch, "swapped.csv")
    assert "column 2 = Force: differs from the other files in its name, Disp there" in reasons(batch, "swapped.csv")


def test_by_numbers_a_record_of_another_component_is_imported_with_a_warning() -> None:
    def at2(component: str) -> bytes:
        rows = "\n".join(" ".join(f"{0.01 * np.sin(k + j):.7E}" for j in range(5)) for k in range(0, 100, 5))
        head = f"PEER STRONG MOTION RECORD\nQuake, 10/15/1979, Station, {component}\n"
        units = "ACCELERATION IN UNITS OF G\nNPTS= 100, DT= .01 SEC\n"
        return (head + units + rows).encode()

    mapping = {"channels": [{"column": 1, "role": "ag", "unit": "g"}]}
    batch, kept = imported({f"{k}.AT2": at2(k) for k in ("090", "180", "UP")}, mapping)
    assert len(kept) == 3
    assert differences(batch, "180.AT2") == ["warning: name of column 1: 180; in the other files 090"]


def test_columns_without_names_are_imported_only_where_their_number_is_the_same() -> None:
    files = {f"{k}.txt": made.csv(made.signals(k)).split(b"\n", 1)[1] for k in range(5)}
    more = made.csv({**made.signals(9), "Temp": made.T}).split(b"\n", 1)[1]
    batch, kept = imported({**files, "more.txt": more}, made.mapping(by_number=True))
    assert len(kept) == 5
    assert "number of columns, 3 there" in reasons(batch, "more.txt")


def test_with_the_step_in_the_mapping_a_time_column_of_another_rate_refuses_the_file() -> None:
    mapping = made.mapping(rate=100.0)
    mapping["channels"] = mapping["channels"][1:]
    batch, kept = imported(made.fifty(), mapping)
    assert "run23.csv" not in kept
    assert "time step, 0.01 there" in reasons(batch, "run23.csv")


def test_a_step_in_the_file_that_contradicts_the_mapping_refuses_the_file() -> None:
    def nested(dt: float) -> bytes:
        return f'{{"dt": {dt}, "disp": {{"data": {made.signals(3)["Disp (mm)"].tolist()}, "units": "mm"}}}}'.encode()

    files = {f"{k}.json": nested(0.01) for k in range(4)} | {"fast.json": nested(0.005)}
    mapping = {"rate": 100, "channels": [{"column": "disp", "role": "x_meas", "unit": "mm"}]}
    batch, kept = imported(files, mapping)
    assert set(kept) == set(files) - {"fast.json"}
    assert "the file states a time step of 0.005 s for column 'disp'; the mapping says 0.01 s" in reasons(batch, "fast.json")


def test_a_unit_beside_the_columns_that_most_files_do_not_state_refuses_the_file() -> None:
    def stated(unit: str) -> bytes:
        head = f"Time,Disp,Force\ns,mm,{unit}\n".encode()
        return head + made.csv(made.signals(4)).split(b"\n", 1)[1]

    mapping = {
        "channels": [
            {"column": "Time", "role": "t", "unit": "s"},
            {"column": "Disp", "role": "x_meas", "unit": "mm"},
            {"column": "Force", "role": "f_meas", "unit": "kN"},
        ]
    }
    files = {**{f"{k}.csv": stated("kN") for k in range(3)}, "n.csv": stated("N"), "none.csv": stated("")}
    batch, kept = imported(files, mapping)
    assert set(kept) == {"0.csv", "1.csv", "2.csv"}
    assert "the mapping says kN" in reasons(batch, "n.csv")
    assert "unit, kN there" in reasons(batch, "none.csv")


def test_where_all_files_contradict_the_mapping_none_is_imported_unless_the_mapping_is_trusted() -> None:
    mapping = made.mapping()
    mapping["channels"][2]["unit"] = "N"
    files = {made.name(k): made.csv(made.signals(k)) for k in range(5)}
    other = made.csv({"Time (s)": made.T, "Disp (mm)": made.T, "Force (N)": made.T})
    batch, kept = imported({**files, "n.csv": other}, mapping)
    assert not kept and "the file states kN" in reasons(batch, "run00.csv")
    mapping["channels"][2]["column"] = 3
    batch, kept = imported({**files, "n.csv": other}, mapping, trust_mapping=True)
    assert set(kept) == set(files)
    assert "unit, kN there" in reasons(batch, "n.csv")
    assert row(batch, "run00.csv").warnings


def test_files_after_the_time_for_a_batch_are_refused_and_named() -> None:
    batch, kept = imported(made.fifty(), made.mapping(), seconds=-1.0)
    assert not kept and "the time of -1 s for one batch was over" in reasons(batch, "run00.csv")
    assert len(batch.rows) == 50 and batch.reference == ""


def test_the_table_has_a_row_for_each_file_and_no_cell_is_a_formula() -> None:
    files = {**{made.name(k): made.csv(made.signals(k)) for k in range(3)}, "=1+1.csv": b"\0\1\2"}
    batch, _ = imported(files, made.mapping())
    rows = [listing.as_dict(one) for one in batch.rows]
    assert [one["imported"] for one in rows] == [True, True, True, False]
    lines = listing.to_csv(rows).splitlines()
    assert lines[0].startswith("file,result,recording,reasons,differences") and lines[4].startswith("'=1+1.csv,refused,,")
    assert lines[1].startswith("run00.csv,imported,") and ",200,100.0,0.0,1.99," in lines[1]


def repeated(changes: Texts[int, tuple[float, float]]) -> dict[str, bytes]:
    """Nine runs of one test, whose forces grow by 1 % from run to run; force and displacement of some times two factors."""
    files = {}
    for k in range(9):
        force, disp = changes.get(k, (1.0, 1.0))
        of = made.signals(5)
        of["Force (kN)"] = force * (1 + 0.01 * k) * of["Force (kN)"]
        of["Disp (mm)"] = disp * of["Disp (mm)"]
        files[made.name(k)] = made.csv(of)
    return files


@pytest.mark.parametrize(
    ("force", "disp", "key", "ratio"),
    [
        (9.80665, 1.0, "f_meas.1", "9.807 (kgf, N)"),
        (1 / 9.80665, 1.0, "f_meas.1", "9.807 (kgf, N)"),
        (4.4482, 1.0, "f_meas.1", "4.448 ("),
        (224.809, 1.0, "f_meas.1", "224.8 (kN, lb)"),
        (1000.0, 1.0, "f_meas.1", "1000 (N, mN)"),
        (1.0, 2.54, "x_meas.1", "2.54 (in, cm)"),
        (1.0, 25.4, "x_meas.1", "25.4 (in, mm)"),
        (1.0, 0.1, "x_meas.1", "10 (cm, mm)"),
    ],
)
def test_a_signal_that_is_larger_by_the_ratio_of_two_units_is_named(force: float, disp: float, key: str, ratio: str) -> None:
    batch, _ = imported(repeated({8: (force, disp)}), made.mapping())
    (only,) = differences(batch, made.name(8))
    assert only.startswith(f"warning: largest value of {key}: ") and ratio in only and " times, as units differ by " in only
    assert not any(differences(batch, made.name(k)) for k in range(8))


@pytest.mark.parametrize(("force", "disp"), [(1.5, 1.0), (10.0, 10.0), (4.5, 4.4), (7.5, 1.0), (1.0, 1.2)])
def test_a_test_of_another_amplitude_is_not_one_of_another_unit(force: float, disp: float) -> None:
    batch, _ = imported(repeated({8: (force, disp)}), made.mapping())
    assert not any(differences(batch, made.name(k)) for k in range(9))


def test_a_mean_that_is_larger_by_the_ratio_of_two_units_is_named_beside_unequal_peaks() -> None:
    files = {}
    for k in range(9):
        of = made.signals(5)
        of["Force (kN)"] = (9.80665 if k == 8 else 1.0) * (2.0 + 0.001 * k + 0.01 * of["Disp (mm)"])
        of["Force (kN)"][50] = 5.0 * 1.5**k  # a spike, unequal in each file
        of["Force (kN)"][51] = 4.0 - of["Force (kN)"][50]
        files[made.name(k)] = made.csv(of)
    batch, _ = imported(files, made.mapping())
    (only,) = [one for one in differences(batch, made.name(8)) if "mean of" in one]
    assert only.startswith("warning: mean of f_meas.1: ") and "9.807 (kgf, N)" in only
    assert not any("mean of" in one for k in range(8) for one in differences(batch, made.name(k)))
