"""GeoNet volumes 1 and 2: for each component 16 lines of text, 40 integers, 60 reals, and ten values of 8 characters a line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

_QUANTITIES = (("Acceleration", "mm/s/s", 1), ("Velocity", "mm/s", 2), ("Displacement", "mm", 3))


@dataclass(frozen=True)
class Component:
    """A component: acceleration, and in volume 2 velocity and displacement. `text`, `integers`, `reals` replace those."""

    direction: str
    bearing: int
    blocks: Sequence[Sequence[float]]
    dt: float = 0.02
    prepended: float = 5.0
    text: dict[int, str] = field(default_factory=dict)
    integers: dict[int, int] = field(default_factory=dict)
    reals: dict[int, float] = field(default_factory=dict)

    @property
    def volume(self) -> int:
        return 2 if len(self.blocks) > 1 else 1


def number(value: float, digits: int) -> str:
    """Eight characters; a large value loses its decimals, not its point: ` -11026.`."""
    text = f"{value:.{digits}f}"
    return (text if len(text) < 8 else f"{value:.0f}.").rjust(8)


def written(*components: Component) -> bytes:
    lines: list[str] = []
    for one in components:
        lines += _header(one)
        for block, (_, _, digits) in zip(one.blocks, _QUANTITIES, strict=False):
            for start in range(0, len(block), 10):
                lines.append("".join(number(value, digits) for value in block[start : start + 10]))
    return ("\r\n".join(lines) + "\r\n").encode()


def _header(one: Component) -> list[str]:
    early = one.prepended if one.volume == 2 else 0.0
    samples = len(one.blocks[0])
    seconds = (samples - 1) * one.dt
    peaks = []
    for block in one.blocks:
        sizes = [abs(value) for value in block]
        at = sizes.index(max(sizes))
        peaks.append((block[at], at * one.dt - early))
    kind = "Corrected" if one.volume == 2 else "Uncorrected"
    text = [
        f"{kind} accelerogram 20161113_110256_HSES_20 GNS Science", "Site HSES      42 31 24S  172 49 50E     Basalt file",
        "Hanmer Springs Emergency Centre", "Instrument Basalt_2430", "Resolution: 24-bit   Instr Period: 0.0050 s",
        "Accelerogram 20161113_110256_HSES_20                 Processed 2016 December 09", "5 km south-west of Waiau",
        "2016 November 13         11:02:56 UT", "Epicentre  42 41 33S 173 01 19E",
        f"Number of points  {samples}    Duration {seconds:.2f} sec",
        f"Instrument corrected data at {one.dt:.3f} sec intervals"
        if one.volume == 2
        else f"Raw readings in units of 1.00 mm/s/s  at intervals of {one.dt:.3f} s",
        "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz", f"Component {one.direction}  Longitudinal",
    ]  # fmt: skip
    for k, (name, unit, digits) in enumerate(_QUANTITIES):
        value = (
            f"{name}:  Peak {peaks[k][0]:.{digits}f} {unit} at {peaks[k][1]:.2f} s  RMS 1.0 {unit}" if k < len(peaks) else ""
        )
        text.append(value or f"{name} record unevaluated")
    integers, reals = [0] * 40, [0.0] * 60
    integers[8], integers[9], integers[18], integers[19], integers[38], integers[39] = 2016, 11, 13, 11, 2, 20000
    integers[27], integers[30] = one.bearing, samples
    integers[33 : 33 + len(one.blocks)] = [len(block) for block in one.blocks]
    reals[20], reals[21], reals[23], reals[24], reals[25] = seconds, early, seconds, 0.005, one.dt
    for (peak, time), place in zip(peaks, (35, 40, 45) if one.volume == 2 else (30,), strict=True):
        reals[place], reals[place + 1] = peak, time
    for line, value in one.text.items():
        text[line - 1] = value
    for number, whole in one.integers.items():
        integers[number - 1] = whole
    for number, real in one.reals.items():
        reals[number - 1] = real
    rows = ["".join(f"{value:8d}" for value in integers[k : k + 10]) for k in range(0, 40, 10)]
    return [*text, *rows, *("".join(f"{value:8.6g}" for value in reals[k : k + 10]) for k in range(0, 60, 10))]
