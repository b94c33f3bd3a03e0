"""The colours of figures: a style sheet for a drawing that stands alone, on white paper.

`report_figures.css` gives the same classes their colours on a page, in both themes. Lines are drawn in units of 1/10 px.
"""

from __future__ import annotations

LINES = ("#0072b2", "#c24d00", "#007a5a", "#9a4a86")
SHADES = ("#f3f5f6", "#f3e1cb", "#f2c893", "#e39e5c", "#d2732a", "#b14a07", "#8f3504", "#6d1f00")


def paper(font: str) -> str:
    """The style sheet of a drawing on paper."""
    lines = "".join(
        f".l{number}{{stroke:{colour}}}.bar.l{number}{{fill:{colour};stroke:none}}" for number, colour in enumerate(LINES)
    )
    shades = "".join(f".h{number}{{fill:{colour}}}" for number, colour in enumerate(SHADES))
    return (
        f"text{{font-family:'{font}';fill:#3d484f}}path{{fill:none}}"
        ".gr{stroke:#e4e8ea;stroke-width:.8}.ze{stroke:#b4bdc2;stroke-width:.9}.ax{stroke:#8b979e;stroke-width:.9}"
        ".l0,.l1,.l2,.l3{stroke-width:11;stroke-linejoin:round;stroke-linecap:round}"
        ".thin{stroke-width:7}.thick{stroke-width:22}.dash{stroke-dasharray:60 40}"
        ".sample{stroke-width:1.6}.sample.thick{stroke-width:2.4}.sample.dash{stroke-dasharray:6 4}"
        f"{lines}{shades}"
        ".sh{fill:#55626a;fill-opacity:.12}.no{fill:#55626a;font-size:85%}"
        f".sp{{fill:{LINES[1]}}}.sn{{fill:{LINES[0]}}}.mk{{fill:{LINES[1]}}}"
        ".note{stroke:#1c2429;stroke-width:1}.trip{stroke:#a0211a;stroke-width:1.4}.span{fill:#1c2429;fill-opacity:.08}"
        ".flag{stroke:none}.flag.note{fill:#1c2429}.flag.trip{fill:#a0211a}.fl{fill:#fff;font-weight:bold}"
    )
