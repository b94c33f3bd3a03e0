"""Rules of saved mappings: save under a name, propose for files of the same layout, rename and delete."""

from __future__ import annotations

import uuid
from datetime import UTC, datetime

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.measured.calculation import FileRead
from app.measured.mapping_rows import MappingRows
from app.models import SavedMapping
from app.problems import Conflict, NotFound
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured import Mapping, mapping_yaml


class SavedMappings:
    """Rules of saved mappings."""

    def __init__(self, session: Session):
        self.session, self.rows = session, MappingRows(session)

    def save(self, name: str, mapping: Mapping, file: FileRead, saved_by: str) -> SavedMapping:
        """Save a mapping, which fits a file, for files of its layout. Raises Conflict where the name is taken."""
        saved = SavedMapping(
            id=str(uuid.uuid4()),
            name=self._free(name),
            layout=file.layout,
            format=file.format,
            columns=file.columns,
            mapping={**mapping.as_dict(), "title": ""},
            saved_by=saved_by,
            saved_at=datetime.now(UTC),
        )
        try:
            self.rows.add(saved)
        except IntegrityError:
            raise _taken(name) from None
        return saved

    def listed(self) -> list[SavedMapping]:
        return self.rows.listed()

    def fitting(self, layout: str) -> list[SavedMapping]:
        """The mappings that were saved for files of a layout, newest first."""
        return self.rows.listed(layout)

    def get(self, mapping_id: str) -> SavedMapping:
        return _found(self.rows.get(mapping_id), mapping_id)

    def _locked(self, mapping_id: str) -> SavedMapping:
        """The mapping with this id as it is now, locked against other writers. Raises NotFound."""
        return _found(self.rows.locked(mapping_id), mapping_id)

    def text(self, mapping_id: str) -> str:
        return mapping_yaml.write(Mapping.read(self.get(mapping_id).mapping))

    def rename(self, mapping_id: str, name: str) -> SavedMapping:
        saved = self._locked(mapping_id)
        if name.strip() != saved.name:
            saved.name = self._free(name)
            try:
                self.session.flush()
            except IntegrityError:
                raise _taken(name) from None
        return saved

    def remove(self, mapping_id: str) -> None:
        self.rows.remove(self._locked(mapping_id))

    def _free(self, name: str) -> str:
        plain = name.strip()
        if not plain:
            raise MeasuredError(Issue("name", "is empty", fix="give the mapping a name, such as the rig and its recorder"))
        if self.rows.named(plain) is not None:
            raise _taken(plain)
        return plain


def _found(saved: SavedMapping | None, mapping_id: str) -> SavedMapping:
    if saved is None:
        raise NotFound(f"There is no saved mapping {mapping_id}.")
    return saved


def _taken(name: str) -> Conflict:
    return Conflict(f"A saved mapping is named {name.strip()} already. Choose another name, or rename or delete that mapping.")
