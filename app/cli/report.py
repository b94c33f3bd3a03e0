"""`rths report`: the report of a recording file or of a run, as HTML, PDF or a data set for DesignSafe."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import Any

from app.cli.run_input import check_folder
from app.cli.settings import settings
from app.cli.written import PDF, check, write
from app.config import Settings
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

ENDINGS = (".h5", ".hdf5")


def report(given: Namespace) -> None:
    """`rths report`: write the report of a recording or of a run. A recording file needs neither database nor server."""
    configured = settings(given)
    named = given.subject.removesuffix(".h5").removesuffix(".hdf5").rpartition("/")[2]
    ending = "-designsafe.zip" if given.designsafe else ".pdf" if given.pdf else ".mat" if given.mat else ".html"
    out = given.out or Path(f"{named}{ending}")
    check_folder(out)
    if given.pdf and out.suffix.lower() != PDF:
        raise RthsError(Issue("--out", "needs the ending .pdf with --pdf", str(out), "choose another name for the report"))
    if not (given.designsafe or given.mat):
        check(out)
    if given.metadata and not given.designsafe:
        raise RthsError(Issue("--metadata", "is used by --designsafe only", str(given.metadata), "add --designsafe"))
    from app.publishing.designsafe.metadata import Metadata

    metadata = _metadata(given.metadata) if given.metadata else Metadata()
    published = _published(given.subject, configured)
    if given.designsafe:
        _write(out, lambda path: published.write_designsafe(path, metadata))
    elif given.mat:
        _write(out, published.write_matlab)
    else:
        write(published.document, out)
    print(f"{out} ({out.stat().st_size / 1e6:.2f} MB)")


def _published(subject: str, configured: Settings) -> Any:
    from app.laboratory.service import Laboratory
    from app.publishing.runs import of_file
    from app.store.motions import motions_of

    path, laboratory = Path(subject), Laboratory(configured)
    if path.exists() or path.suffix in ENDINGS:
        return of_file(path, laboratory, motions_of(configured))
    return _of_row(subject, configured, laboratory)


def _of_row(run_id: str, configured: Settings, laboratory: Any) -> Any:
    """A run in the database of the data folder."""
    from app import db
    from app.annotations.service import AnnotationService
    from app.problems import Conflict, NotFound
    from app.publishing.runs import RunReports
    from app.runs.service import RunService
    from app.store.motions import motions_of

    if not configured.database_url and not (configured.data / "rths.sqlite").exists():
        fix = "give a recording file, or the data folder with --data"
        raise RthsError(Issue(run_id, "is no file, and there is no database in the data folder", str(configured.data), fix))
    engine = db.connect(configured.url)
    try:
        with db.unit_of_work(db.sessions(engine)) as session:
            runs = RunService(session, motions_of(configured))
            return RunReports(runs, AnnotationService(session, runs), laboratory, configured).of(run_id)
    except (Conflict, NotFound) as error:
        raise RthsError(Issue(run_id, str(error).rstrip("."), fix="`rths report RECORDING.h5` reads a file")) from None
    finally:
        engine.dispose()


def _metadata(path: Path) -> Any:
    """The metadata in a YAML or JSON file. Raises RthsError with every issue."""
    from pydantic import ValidationError
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    from app.publishing.designsafe.metadata import Metadata

    try:
        data = YAML(typ="safe").load(path.read_text(encoding="utf-8"))
        return Metadata.model_validate(data or {})
    except (OSError, UnicodeDecodeError) as error:
        raise RthsError(Issue("--metadata", f"cannot be read: {error}", str(path))) from None
    except YAMLError as error:
        raise RthsError(Issue("--metadata", f"is not valid YAML: {str(error).splitlines()[0]}", str(path))) from None
    except ValidationError as error:
        issues = [Issue(".".join(map(str, one["loc"])), one["msg"][:1].lower() + one["msg"][1:]) for one in error.errors()]
        raise RthsError(issues) from None


def _write(target: Path, make: Any) -> None:
    with files.temporary(target) as written:
        make(written)
        written.replace(target)
