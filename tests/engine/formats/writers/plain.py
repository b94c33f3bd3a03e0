"""Text of no known format, written from numbers: separators, decimal signs, quotation marks, line ends, exponents, headers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

Values = Sequence[float] | np.ndarray


def number(value: float, style: str = "fixed", decimal: str = ".", digits: int = 4) -> str:
    """A number as a program writes it: `fixed`, with a Fortran `D` exponent, or with an `E` exponent."""
    text = f"{value:.{digits}f}" if style == "fixed" else f"{value:.{digits}E}".replace("E", style)
    return text.replace(".", decimal)


def record(values: Values, header: Sequence[str] = (), per_line: int = 1, style: str = "fixed", width: int = 0) -> str:
    """A record, several values a line, in fields of a fixed width or with blanks between."""
    fields = [number(value, style) for value in values]
    lines = [fields[start : start + per_line] for start in range(0, len(fields), per_line)]
    return text([*header, *("".join(field.rjust(width) for field in line) if width else " ".join(line) for line in lines)])


def table(
    columns: Iterable[Values],
    header: Sequence[str] = (),
    separator: str = ",",
    decimal: str = ".",
    style: str = "fixed",
    quoted: bool = False,
    digits: int = 4,
) -> str:
    """Rows of a table below a header."""
    mark = '"' if quoted else ""
    rows = ([f"{mark}{number(value, style, decimal, digits)}{mark}" for value in row] for row in zip(*columns, strict=True))
    return text([*header, *(separator.join(row) for row in rows)])


def text(lines: Sequence[str], end: str = "\n") -> str:
    """The lines with their ends."""
    return "".join(line + end for line in lines)


def burst(count: int = 400, step: float = 0.01, peak: float = 182.0, at: float = 1.71) -> tuple[np.ndarray, np.ndarray]:
    """Times and a burst of acceleration whose largest value is `peak` at `at`."""
    times = np.arange(count) * step
    return times, peak * np.exp(-(((times - at) / 0.4) ** 2)) * np.cos(19.0 * (times - at))
