"""Commands that import, diagnose and report recordings, and score diagnoses."""

from __future__ import annotations

from pathlib import Path

from app.cli.command import Commands, command, data_folder


def add(commands: Commands) -> None:
    """Declare the commands."""
    about = "import a file of measurements, or all files of a folder or ZIP archive, as recordings"
    imports = command(commands, "import", "app.cli.measurements:measurements", about)
    imports.add_argument(
        "file", type=Path, metavar="FILE", help="measurements, in a format of docs/formats.md; a folder or .zip of such files"
    )
    imports.add_argument("--map", type=Path, metavar="MAP.yaml", help="file with the mapping: role and unit of each column")
    imports.add_argument(
        "--out", type=Path, metavar="OUT", help="file to write the recording to (HDF5); a folder for many files"
    )
    imports.add_argument("--guess", action="store_true", help="print a proposed mapping and import nothing")
    imports.add_argument("--table", type=Path, metavar="FILE.csv", help="of many files: write the table of what differs as CSV")
    imports.add_argument(
        "--trust-mapping",
        action="store_true",
        help="of many files: take the units and the step of the mapping where most files state others",
    )

    diagnose = command(
        commands,
        "diagnose",
        "app.cli.diagnose:diagnose",
        "compare a recording with a plan and name the physics that its models leave out",
    )
    diagnose.add_argument("plan", metavar="PLAN.yaml", help="file with the plan to check; linear: a fitted linear model")
    diagnose.add_argument("recording", type=Path, metavar="REC.h5", help="recording of the stations of the plan")
    diagnose.add_argument(
        "--holdout", type=Path, nargs="+", default=[], metavar="REC.h5", help="held-out recordings: tested, not fitted"
    )
    diagnose.add_argument(
        "--with", dest="more", type=Path, nargs="+", default=[], metavar="REC.h5", help="further recordings to fit"
    )
    diagnose.add_argument("--level", type=float, default=0.01, metavar="P", help="false-alarm rate (default %(default)s)")
    diagnose.add_argument("--json", type=Path, metavar="OUT", help="write the verdict as one JSON object")
    diagnose.add_argument("--report", type=Path, metavar="OUT", help="write the report: OUT.html or OUT.pdf")

    report = command(commands, "report", "app.cli.report:report", "write the report of a recording file or of a run")
    report.add_argument("subject", metavar="RECORDING.h5", help="recording file, or the identifier of a run in the data folder")
    forms = report.add_mutually_exclusive_group()
    forms.add_argument("--html", action="store_true", help="one HTML file below 1 MB (default)")
    forms.add_argument("--pdf", action="store_true", help="PDF")
    forms.add_argument("--mat", action="store_true", help="the recording as a MATLAB file")
    forms.add_argument("--designsafe", action="store_true", help="data set for DesignSafe as a ZIP archive; needs --metadata")
    report.add_argument("--metadata", type=Path, metavar="FILE.yaml", help="metadata of the data set: docs/reports.md")
    report.add_argument("--out", type=Path, metavar="OUT", help="file to write (default: named after the recording)")
    data_folder(report)

    prove = command(
        commands, "prove", "app.cli.prove:prove", "score diagnoses on generated recordings with known left-out physics"
    )
    prove.add_argument("--cases", type=int, default=100, metavar="N", help="number of recordings (default %(default)s)")
    prove.add_argument("--seed", type=int, default=0, metavar="S", help="seed of the cases (default %(default)s)")
    prove.add_argument("--workers", type=int, default=2, metavar="N", help="diagnoses at the same time (default %(default)s)")
    prove.add_argument(
        "--only", metavar="KIND/LEVEL", help="cases of one kind of test, of one level, or of both; KIND/EFFECT: of one effect"
    )
    prove.add_argument("--keep", type=Path, metavar="DIR", help="folder to store plans, recordings, truths and verdicts in")
    prove.add_argument("--json", type=Path, required=True, metavar="OUT", help="write every score as one JSON object")
    prove.add_argument(
        "--reliability", type=Path, metavar="OUT.svg", help="draw the share of right names against their probability"
    )
    prove.add_argument(
        "--certificate", action="store_true", help="also write the error rates that verdicts cite into the engine"
    )
    prove.add_argument(
        "--calibrate",
        action="store_true",
        help="only fit the map of probabilities to these cases and write it into the engine",
    )
    prove.add_argument(
        "--picture", type=Path, metavar="OUT.svg", help="plot the rates against the strength of the left-out physics"
    )
    prove.add_argument("--table", action="store_true", help="also print a row for each effect")

    scores = command(
        commands, "scores", "app.cli.scores:scores", "fit models to published measurements and compare with published errors"
    )
    scores.add_argument("folder", type=Path, metavar="FOLDER", help="folder with the data sets of docs/scores.md")
    scores.add_argument("--json", type=Path, metavar="OUT", help="write every score as one JSON object")
