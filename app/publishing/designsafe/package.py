"""The ZIP archive of a data set: folders as in a publication, and `metadata.json` with the entities and their graph."""

from __future__ import annotations

import json
import re
import unicodedata
import uuid
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.publishing.designsafe.contents import Entity, entities
from app.publishing.designsafe.entities import FACILITIES, HAZARDS, KINDS, PROJECT, SIMULATION, SIMULATION_FOLDER
from app.publishing.designsafe.metadata import Category, Metadata, missing
from rths_engine.foundation.errors import RthsError
from rths_engine.recordings.run_file import Recording

STORED = (".h5", ".pdf")  # compressed already
README = """This data set follows the hybrid simulation model of DesignSafe's Data Depot.

1. Create the project in the Data Depot (type: hybrid simulation), or open it.
2. Unpack this archive into the project. A published data set has no archives.
3. In the Curation Directory, add the entities of metadata.json: their titles and descriptions are there.
   Each folder holds the files of one entity, below the entity that it belongs to.
4. Relate the entities as the folders are nested, assign each folder to its entity, choose the licence, and publish.

metadata.json has the fields of the Data Depot (camelCase): `baseProject`, `entities` with uuid, name and value, and `tree`, a
node-link graph. File paths are relative to the project. Data are raw: as recorded by the controller, in the units of the column
headings; report/data_dictionary.csv explains every column.
"""


@dataclass(frozen=True, slots=True)
class _Node:
    """An entity with its identifiers, its folder and the node above it."""

    kind: str
    name: str
    id: str
    uuid: str
    folder: str
    above: str
    value: dict[str, Any]


def check(given: Metadata, recording: Recording) -> None:
    """Raise RthsError with everything that a data set still needs."""
    if issues := missing(given, recording):
        raise RthsError(issues)


def write(
    target: Path, run: Mapping[str, Any], recording: Recording, path: Path, given: Metadata, reports: Mapping[str, bytes]
) -> None:
    """Write the archive of a run whose metadata are complete (`check`)."""
    made = list(entities(run, recording, path, reports))
    root = given.project.project_id.strip() or _slug(given.project.title)
    project = _node(PROJECT, "", "NODE_ROOT", root, "", _project(given, recording))
    simulation = _simulation(given, recording, run, project)
    nodes = [project, simulation]
    for entity in made:
        nodes.append(_of(entity, nodes, given, recording))
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        archive.writestr(f"{root}/README.txt", README)
        archive.writestr(f"{root}/metadata.json", json.dumps(_metadata(nodes), indent=2, ensure_ascii=False))
        for entity, node in zip(made, nodes[2:], strict=True):
            for name, content in entity.files.items():
                _add(archive, f"{node.folder}/data/{name}", content)


def _add(archive: zipfile.ZipFile, name: str, content: bytes | Path) -> None:
    how = zipfile.ZIP_STORED if name.endswith(STORED) else zipfile.ZIP_DEFLATED
    if isinstance(content, Path):
        archive.write(content, name, how)
    else:
        archive.writestr(name, content, how)


def _node(name: str, kind: str, node_id: str, folder: str, above: str, value: dict[str, Any]) -> _Node:
    return _Node(kind, name, node_id, str(uuid.uuid4()), folder, above, value)


def _project(given: Metadata, recording: Recording) -> dict[str, Any]:
    one = given.project
    hazards = one.nh_types or (["Earthquake"] if recording.plan.motion.kind != "none" else [])
    return {
        "projectId": one.project_id,
        "projectType": "hybrid_simulation",
        "title": one.title.strip(),
        "description": one.description.strip(),
        "pi": one.pi.strip(),
        "coPis": one.co_pis,
        "keywords": one.keywords,
        "nhTypes": [_hazard(hazard) for hazard in hazards],
        "awardNumbers": [{**award.model_dump(by_alias=True), "order": number} for number, award in enumerate(given.awards)],
        "license": given.licence,
    }


def _simulation(given: Metadata, recording: Recording, run: Mapping[str, Any], project: _Node) -> _Node:
    one = given.hybrid_simulation
    kind = one.simulation_type or ("Earthquake" if recording.plan.motion.kind != "none" else "Other")
    value = {
        "title": one.title.strip(),
        "description": one.description.strip(),
        "simulationType": {"id": kind, "name": kind},
        "procedureStart": run.get("started_at"),
        "procedureEnd": run.get("finished_at"),
        "keywords": one.keywords,
        "authors": [
            {**author.model_dump(by_alias=True), "order": number, "guest": not author.username, "authorship": True}
            for number, author in enumerate(one.authors)
        ],
        "relatedWork": [{"title": work, "href": work, "type": "Context", "hrefType": "URL"} for work in one.related_work],
        "facility": _facility(one.facility),
        "project": [project.uuid],
    }
    folder = f"{project.folder}/{SIMULATION_FOLDER}--{_slug(one.title)}"
    return _node(SIMULATION, "simulation", f"NODE_{uuid.uuid4()}", folder, "NODE_ROOT", value)


def _of(entity: Entity, nodes: Sequence[_Node], given: Metadata, recording: Recording) -> _Node:
    """The node of an entity under the last node of the kind above it."""
    kind = KINDS[entity.kind]
    above = next(node for node in reversed(nodes) if node.kind == (kind.above or "simulation"))
    said = given.categories.get(entity.kind, Category())
    title, description = said.title or entity.title, said.description or entity.description
    if said.title and entity.number:  # one title for the entities of all stations
        title = f"{title}, station {entity.number}"
    data = (
        "/data" if above.kind == "simulation" else ""
    )  # DesignSafe puts the entities of a publication into a folder of this name
    folder = f"{above.folder}{data}/{kind.folder}--{_slug(title)}"
    value: dict[str, Any] = {"title": title, "description": description, "project": [nodes[0].uuid]}
    value["hybridSimulations"] = [nodes[1].uuid]
    if entity.kind in ("coordinator", "sim_substructure"):
        value["applicationVersion"] = f"RTHS control room {recording.attrs.get('code_version', '')}".strip()
    value["fileObjs"] = [_file(nodes[0], folder, name, content) for name, content in entity.files.items()]
    return _node(kind.name, entity.kind, f"NODE_{uuid.uuid4()}", folder, above.id, value)


def _file(project: _Node, folder: str, name: str, content: bytes | Path) -> dict[str, Any]:
    path = f"{folder.partition('/')[2]}/data/{name}"
    length = content.stat().st_size if isinstance(content, Path) else len(content)
    return {"system": f"project-{project.uuid}", "name": name, "path": f"/{path}", "type": "file", "length": length}


def _metadata(nodes: Sequence[_Node]) -> dict[str, Any]:
    listed = [{"uuid": node.uuid, "name": node.name, "value": node.value} for node in nodes]
    order: dict[str, int] = {}
    graph = []
    for node in nodes:
        place = order[node.above] = order.get(node.above, -1) + 1
        graph.append({"id": node.id, "uuid": node.uuid, "name": node.name, "order": place})
    links = [{"source": node.above, "target": node.id} for node in nodes if node.above]
    tree = {"directed": True, "multigraph": False, "graph": {}, "nodes": graph, "links": links}
    return {"baseProject": listed[0], "entities": listed[1:], "tree": tree}


def _hazard(said: str) -> dict[str, str]:
    known = next((key for key, name in HAZARDS.items() if said.lower() in (key, name.lower())), said)
    return {"id": known, "name": HAZARDS.get(known, said)}


def _facility(said: str) -> dict[str, str] | None:
    if not said.strip():
        return None
    known = next((key for key, name in FACILITIES.items() if said in (key, name)), "other")
    return {"id": known, "name": FACILITIES.get(said, said)}


def _slug(title: str) -> str:
    """The title as a name of a folder, as the Data Depot makes it: lower case, letters, digits and hyphens."""
    plain = unicodedata.normalize("NFKD", title).encode("ascii", "ignore").decode()
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", plain.lower())).strip("-_")[:120] or "untitled"
