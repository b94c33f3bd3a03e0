"""What people give for a data set on DesignSafe, and what of it is missing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field
from pydantic.alias_generators import to_camel

from app.publishing.designsafe.entities import (
    CATEGORY_DESCRIPTION,
    HAZARDS,
    KINDS,
    LICENCES,
    PROJECT_DESCRIPTION,
    SIMULATION_DESCRIPTION,
    SIMULATION_TYPES,
)
from app.text import Storable
from rths_engine.foundation.errors import Issue
from rths_engine.recordings.run_file import Recording

Line = Annotated[Storable, Field(max_length=300)]
Paragraphs = Annotated[Storable, Field(max_length=20_000)]
HYBRID = "export a run of a hybrid test; DesignSafe has other types of project for other tests"


class _Given(BaseModel):
    model_config = ConfigDict(extra="forbid", alias_generator=to_camel, populate_by_name=True)


class Author(_Given):
    """An author. `username` is that of the DesignSafe account; without it the author is a guest."""

    fname: Line = Field("", description="first name")
    lname: Line = Field("", description="last name")
    inst: Line = Field("", description="institution")
    email: Line = ""
    username: Line = ""


class Project(_Given):
    """The project in the Data Depot that the data set belongs to."""

    project_id: Line = Field("", description="number in the Data Depot, such as PRJ-1234, once the project was created there")
    title: Line = ""
    description: Paragraphs = Field("", description="1000 to 5000 characters: aim, audience, and what is unique")
    pi: Line = Field("", description="DesignSafe user name of the principal investigator")
    co_pis: list[Line] = Field([], max_length=50)
    keywords: list[Line] = Field([], max_length=50)
    nh_types: list[Line] = Field([], max_length=20, description=f"natural hazards: {', '.join(HAZARDS.values())}")


class Award(_Given):
    """An award that paid for the research."""

    name: Line = ""
    number: Line = ""
    funding_source: Line = ""


class Simulation(_Given):
    """The hybrid simulation that gets its own DOI."""

    title: Line = Field("", description="title of the publication, other than that of the project")
    description: Paragraphs = Field(
        "", description="750 to 5000 characters: what was studied, how, the outcome, how to reuse it"
    )
    simulation_type: Line = Field("", description="Earthquake, Wind or Other; by default Earthquake under a ground motion")
    authors: list[Author] = Field([], max_length=100)
    keywords: list[Line] = Field([], max_length=50)
    facility: Line = Field("", description="facility of the test, if any")
    related_work: list[Line] = Field([], max_length=50, description="addresses or DOIs of related publications")


class Category(_Given):
    """Title and description of an entity that replace those made from the run."""

    title: Line = ""
    description: Paragraphs = ""


class Metadata(_Given):
    """The metadata of a data set that do not follow from the run. Field names are DesignSafe's."""

    project: Project = Project()
    hybrid_simulation: Simulation = Simulation()
    licence: Line = Field("", alias="license", description=f"one of: {'; '.join(LICENCES)}")
    awards: list[Award] = Field([], max_length=50)
    categories: dict[str, Category] = Field({}, max_length=20, description=f"by the kind of entity: {', '.join(KINDS)}")


def missing(given: Metadata, recording: Recording) -> list[Issue]:
    """Every required entity and field that is missing or too short, with how to mend it; empty for a complete data set."""
    return [*_entities(recording), *_project(given.project), *_simulation(given), *_categories(given), *_licence(given)]


def _entities(recording: Recording) -> Iterator[Issue]:
    plan = recording.plan
    if plan.structure.kind == "none" or plan.driven:
        yield Issue("sim_substructure", "is missing: the test computes no structure", fix=HYBRID)
    if not plan.stations:
        yield Issue("exp_substructure", "is missing: the test has no station", fix=HYBRID)
    if not len(recording.signals):
        yield Issue("coordinator_output", "has no file: the test stopped before its first sample", fix="run the test again")


def _project(project: Project) -> Iterator[Issue]:
    yield from _text("project.title", project.title, "give the title of the project in the Data Depot")
    yield from _long("project.description", project.description, PROJECT_DESCRIPTION)
    yield from _text("project.pi", project.pi, "give the DesignSafe user name of the principal investigator")
    yield from _some("project.keywords", project.keywords, "give at least one keyword")
    for hazard in project.nh_types:
        if hazard.lower() not in HAZARDS and hazard not in HAZARDS.values():
            yield Issue(
                "project.nhTypes", "is not a natural hazard of DesignSafe", hazard, f"one of {', '.join(HAZARDS.values())}"
            )


def _simulation(given: Metadata) -> Iterator[Issue]:
    one, where = given.hybrid_simulation, "hybridSimulation"
    yield from _text(f"{where}.title", one.title, "give the title of the publication")
    if one.title.strip() and one.title.strip() == given.project.title.strip():
        yield Issue(
            f"{where}.title", "is the title of the project", one.title, "give a title of its own: it stands in the citation"
        )
    yield from _long(f"{where}.description", one.description, SIMULATION_DESCRIPTION)
    yield from _some(f"{where}.keywords", one.keywords, "give at least one keyword")
    yield from _some(f"{where}.authors", one.authors, "give at least one author with fname, lname and inst")
    for number, author in enumerate(one.authors):
        for name, value in (("fname", author.fname), ("lname", author.lname), ("inst", author.inst)):
            yield from _text(f"{where}.authors.{number}.{name}", value, "the citation of the data set needs it")
    if one.simulation_type and len(one.simulation_type) > 100:
        yield Issue(f"{where}.simulationType", "is too long", one.simulation_type, f"usual are {', '.join(SIMULATION_TYPES)}")


def _categories(given: Metadata) -> Iterator[Issue]:
    for kind, one in given.categories.items():
        if kind not in KINDS:
            yield Issue(f"categories.{kind}", "is not a kind of entity", fix=f"one of {', '.join(KINDS)}")
        elif one.description:
            yield from _long(f"categories.{kind}.description", one.description, CATEGORY_DESCRIPTION)


def _licence(given: Metadata) -> Iterator[Issue]:
    if given.licence not in LICENCES:
        problem = "is not a licence of DesignSafe" if given.licence else "is missing"
        yield Issue("license", problem, given.licence or None, f"one of: {'; '.join(LICENCES)}")


def _text(where: str, value: str, fix: str) -> Iterator[Issue]:
    if not value.strip():
        yield Issue(where, "is missing", fix=fix)


def _some(where: str, values: object, fix: str) -> Iterator[Issue]:
    if not values:
        yield Issue(where, "is missing", fix=fix)


def _long(where: str, value: str, bounds: tuple[int, int]) -> Iterator[Issue]:
    length, (least, most) = len(value.strip()), bounds
    if not least <= length <= most:
        problem = "is missing" if not length else f"has {length} characters"
        yield Issue(where, problem, fix=f"DesignSafe needs {least} to {most} characters")
