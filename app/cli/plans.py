"""`rths plan`, `rths motions`, `rths version`."""

from __future__ import annotations

from argparse import Namespace

from app.cli.settings import settings
from app.store.motions import motions_of
from rths_engine import __version__
from rths_engine.foundation import units
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml


def plan(given: Namespace) -> None:
    """`rths plan`: print a template as YAML, or list the templates."""
    if given.name:
        print(plan_to_yaml(templates.template(given.name)), end="")
        return
    for name in templates.names():
        print(f"{name:24} {templates.template(name).name}")


def motions(given: Namespace) -> None:
    """`rths motions`: list the ground-motion records with PGA, time step and duration."""
    print(f"{'Name':48} {'PGA, g':>7} {'Step, s':>7} {'Duration, s':>11}  Record")
    for record in motions_of(settings(given)).summaries():
        if record.problem:
            print(f"{record.name:48} can't be used: {record.problem}")
        else:
            pga = units.from_si(record.pga, "g")
            print(f"{record.name:48} {pga:7.3f} {record.dt:7.4g} {record.duration:11.1f}  {record.title}")


def version(_: Namespace) -> None:
    """`rths version`: print the version."""
    print(__version__)
