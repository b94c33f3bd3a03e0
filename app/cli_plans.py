"""`rths plan`, `rths motions`, `rths version`."""

from __future__ import annotations

from argparse import Namespace

from app.cli_settings import settings
from rths_engine import __version__, templates, units
from rths_engine.ground_motions import MotionLibrary


def plan(given: Namespace) -> None:
    if given.name:
        print(templates.template(given.name).to_yaml(), end="")
        return
    for name in templates.names():
        print(f"{name:24} {templates.template(name).name}")


def motions(given: Namespace) -> None:
    print(f"{'Name':48} {'PGA g':>7} {'Step s':>7} {'Length s':>8}  Record")
    for record in MotionLibrary(settings(given).motions).summaries():
        if record.problem:
            print(f"{record.name:48} can't be used: {record.problem}")
        else:
            pga = units.from_si(record.pga, "g")
            print(f"{record.name:48} {pga:7.3f} {record.dt:7.4g} {record.duration:8.1f}  {record.title}")


def version(_: Namespace) -> None:
    print(__version__)
