"""LabVIEW measurement files as LabVIEW writes them: six decimals, one header for the file and one for each segment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

END = "***End_of_Header***"


@dataclass(frozen=True)
class Signal:
    name: str
    values: Sequence[float]
    unit: str = "N"
    dt: float = 0.004
    x0: float = 0.0
    time: str = "10:00:00.000000"
    x_unit: str = ""


def number(value: float, decimal: str = ".") -> str:
    """LabVIEW writes six decimals, and an exponent below 1E-4."""
    text = f"{value:.6f}" if value == 0 or abs(value) >= 1e-4 else f"{value:.6E}".replace("E-0", "E-")
    return text.replace(".", decimal)


def written(
    segments: Sequence[Sequence[Signal]],
    *,
    x_columns: str = "No",
    separator: str = "\t",
    decimal: str = ".",
    comment: str = "",
    headings: str = "Yes",
    special: bool = False,
    pref: str = "Absolute",
) -> bytes:
    """A file of segments of signals."""
    names = {"\t": "Tab", ",": "Comma", ";": "Semicolon"}
    lines = [
        "LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", f"Separator\t{names[separator]}",
        f"Decimal_Separator\t{decimal}", f"Multi_Headings\t{headings}", f"X_Columns\t{x_columns}", f"Time_Pref\t{pref}",
        "Operator\tAna", "Date\t2024/05/06",
        "Time\t10:00:00.000000", f"{END}\t", "",
    ]  # fmt: skip
    if special:
        lines += [separator.join(["***Start_Special***"]), "VI serial number 12", "0.5 0.7", "***End_Special***", ""]
    for signals in segments:
        lines += [*header(signals, x_columns, separator, decimal), *rows(signals, x_columns, separator, decimal, comment), ""]
    return "\r\n".join(lines).encode()


def header(signals: Sequence[Signal], x_columns: str, separator: str, decimal: str) -> list[str]:
    apart = separator * (2 if x_columns == "Multi" else 1)

    def line(key: str, fields: Sequence[str]) -> str:
        return separator.join([key, apart.join(fields), ""])

    return [
        line("Channels", [str(len(signals))]),
        line("Samples", [str(len(one.values)) for one in signals]),
        line("Date", ["2024/05/06" for _ in signals]),
        line("Time", [one.time.replace(".", decimal) for one in signals]),
        line("Y_Unit_Label", [one.unit for one in signals]),
        line("X_Dimension", ["Time" for _ in signals]),
        *([line("X_Unit_Label", [one.x_unit for one in signals])] if any(one.x_unit for one in signals) else []),
        line("X0", [f"{one.x0:.16E}".replace(".", decimal) for one in signals]),
        line("Delta_X", [number(one.dt, decimal) for one in signals]),
        END + separator * len(signals),
        separator.join(
            [
                *(["X_Value"] if x_columns != "Multi" else []),
                *[f"X_Value{separator}{one.name}" if x_columns == "Multi" else one.name for one in signals],
                "Comment",
            ]
        ),
    ]


def rows(signals: Sequence[Signal], x_columns: str, separator: str, decimal: str, comment: str) -> list[str]:
    found = []
    for k in range(max(len(one.values) for one in signals)):
        fields = (
            [] if x_columns == "Multi" else [number(signals[0].x0 + k * signals[0].dt, decimal) if x_columns == "One" else ""]
        )
        for one in signals:
            if x_columns == "Multi":
                fields.append(number(one.x0 + k * one.dt, decimal) if k < len(one.values) else "")
            fields.append(number(one.values[k], decimal) if k < len(one.values) else "")
        found.append(separator.join([*fields, *([comment] if comment and k == 1 else [])]))
    return found
