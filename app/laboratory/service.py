"""The identity of the laboratory, stored in the data folder: the command line reads it without a database.

What the settings page has stored takes precedence over the variables RTHS_LABORATORY, RTHS_LABORATORY_ADDRESS and
RTHS_LABORATORY_LOGO, which give the first values.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from pydantic import ValidationError

from app.config import Settings
from app.laboratory.logo import ENDINGS, LARGEST, Image, checked
from app.laboratory.schemas import Identity, LaboratoryOut, Logo
from app.problems import NotFound
from app.store.filed import LABORATORY
from app.store.opening import store_of
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

FRESH_S = 2.0  # changes that another web process made show within this time
NONE = "none"  # ending of the file that says that the logo was removed


class Laboratory:
    """Reads and writes the identity of the laboratory."""

    def __init__(self, settings: Settings):
        self.settings, self.store = settings, store_of(settings)

    @property
    def folder(self) -> Path:
        """The local folder of the stored identity."""
        return self.store.folder(LABORATORY, within_s=FRESH_S)

    @property
    def identity(self) -> Identity:
        """Name, address and signatures. Raises RthsError where the stored file was damaged."""
        path = self.folder / "identity.json"
        if not path.exists():
            return Identity(name=self.settings.laboratory, address=self.settings.laboratory_address)
        try:
            return Identity.model_validate(json.loads(path.read_text(encoding="utf-8")))
        except (ValidationError, ValueError):
            fix = "save the settings of the laboratory again"
            raise RthsError(Issue("laboratory/identity.json", "is damaged", fix=fix)) from None

    def save(self, identity: Identity) -> None:
        """Store name, address and signatures."""
        self.folder.mkdir(parents=True, exist_ok=True)
        files.write(self.folder / "identity.json", json.dumps(identity.model_dump(), ensure_ascii=False))
        self.store.keep(LABORATORY, "identity.json")

    @property
    def logo(self) -> Image | None:
        """The logo; None where there is none. Raises RthsError where RTHS_LABORATORY_LOGO names no image."""
        for media_type, ending in ENDINGS.items():
            path = self.folder / f"logo.{ending}"
            if path.exists():
                return Image(path.read_bytes(), media_type)
        given = self.settings.laboratory_logo
        if given is None or (self.folder / f"logo.{NONE}").exists():
            return None
        return checked(_read(given))

    def save_logo(self, data: bytes) -> None:
        """Store the logo. Raises RthsError where it is not an acceptable image."""
        image = checked(data)
        self.folder.mkdir(parents=True, exist_ok=True)
        target = self.folder / f"logo.{image.ending}"
        with files.temporary(target) as written:
            written.write_bytes(image.data)
            written.replace(target)
        self.store.keep(LABORATORY, target.name)
        self._forget(image.ending)

    def remove_logo(self) -> None:
        """Remove the logo. Raises NotFound where there is none."""
        if self.logo is None:
            raise NotFound("The laboratory has no logo.")
        self.folder.mkdir(parents=True, exist_ok=True)
        if self.settings.laboratory_logo is not None:
            (self.folder / f"logo.{NONE}").touch()
            self.store.keep(LABORATORY, f"logo.{NONE}")
        self._forget(NONE)

    def shown(self) -> LaboratoryOut:
        """The identity as JSON."""
        logo = self.logo
        about = None
        if logo:
            about = Logo(media_type=logo.media_type, size=len(logo.data), sha256=hashlib.sha256(logo.data).hexdigest())
        return LaboratoryOut(**self.identity.model_dump(), logo=about)

    def _forget(self, kept: str) -> None:
        for ending in (*ENDINGS.values(), NONE):
            if ending != kept:
                self.store.drop(LABORATORY, f"logo.{ending}")


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(LARGEST + 1)
    except OSError as error:
        fix = "correct or unset the variable"
        raise RthsError(Issue("RTHS_LABORATORY_LOGO", f"can't be read: {error.strerror}", str(path), fix)) from None
