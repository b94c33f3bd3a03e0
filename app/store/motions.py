"""The library of ground motions and the folder of FMUs of an installation, also where they lie behind a network."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from app.config import Settings
from app.store.base import Store
from app.store.filed import FMUS, MOTIONS
from app.store.opening import store_of
from rths_engine.parts.ground_motions import Motion, MotionLibrary
from rths_engine.parts.ground_motions.stored import SUFFIX


def motions_of(settings: Settings) -> MotionLibrary:
    """The library of ground motions: bundled and added records."""
    return StoredMotions(store_of(settings))


def fmus_of(settings: Settings) -> Path:
    """A local folder with the FMUs that plans may name."""
    return store_of(settings).folder(FMUS)


class StoredMotions(MotionLibrary):
    """A library in the store. Its folder is brought up to date when a record is looked for that is not bundled."""

    def __init__(self, store: Store):
        self.store = store

    @cached_property
    def folder(self) -> Path:  # type: ignore[override]
        return self.store.folder(MOTIONS)

    def add(self, motion: Motion) -> None:
        super().add(motion)
        self.store.keep(MOTIONS, f"{motion.name}{SUFFIX}")

    def remove(self, name: str) -> None:
        super().remove(name)
        self.store.drop(MOTIONS, f"{name}{SUFFIX}")
