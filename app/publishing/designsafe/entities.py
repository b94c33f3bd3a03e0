"""The entities of a hybrid simulation in DesignSafe's Data Depot, and what each requires.

Source: the portal of DesignSafe-CI (github.com/DesignSafe-CI/portal, April 2026). `schema_models/hybrid_sim.py` and `base.py`
give the fields, `graph_constructor.py` which entity may stand under which, `project_publish_operations.py` which entities a
publication requires (and that each of them has files), `schema_models/__init__.py` and `path_operations.py` the names of the
folders, and the forms of the client the lengths of descriptions and the licences.
"""

from __future__ import annotations

from dataclasses import dataclass

PROJECT = "designsafe.project"
SIMULATION = "designsafe.project.hybrid_simulation"


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of entity: its name in the Data Depot and of its folder, the kind above it, whether a publication needs it."""

    name: str
    folder: str
    title: str
    above: str
    required: bool = False


KINDS: dict[str, Kind] = {
    "global_model": Kind(f"{SIMULATION}.global_model", "Global-model", "Global model", "", required=True),
    "coordinator": Kind(f"{SIMULATION}.coordinator", "Coordinator", "Coordinator", "global_model", required=True),
    "coordinator_output": Kind(f"{SIMULATION}.coordinator_output", "Coordinator-output", "Coordinator output", "coordinator"),
    "sim_substructure": Kind(
        f"{SIMULATION}.sim_substructure", "Simulation-substructure", "Simulation substructure", "coordinator", required=True
    ),
    "sim_output": Kind(f"{SIMULATION}.sim_output", "Simulation-output", "Simulation output", "sim_substructure"),
    "exp_substructure": Kind(
        f"{SIMULATION}.exp_substructure", "Experimental-substructure", "Experimental substructure", "coordinator", required=True
    ),
    "exp_output": Kind(f"{SIMULATION}.exp_output", "Experimental-output", "Experimental output", "exp_substructure"),
    "analysis": Kind(f"{SIMULATION}.analysis", "Analysis", "Analysis", ""),
    "report": Kind(f"{SIMULATION}.report", "Report", "Report", ""),
}
SIMULATION_FOLDER = "Hybrid-simulation"

PROJECT_DESCRIPTION = (1000, 5000)  # characters
SIMULATION_DESCRIPTION = (750, 5000)
CATEGORY_DESCRIPTION = (50, 5000)
HAZARDS = {
    "drought": "Drought",
    "earthquake": "Earthquake",
    "extreme temperatures": "Extreme Temperatures",
    "fire": "Wildfire",
    "flood": "Flood",
    "hurricane/tropical storm": "Hurricane/Tropical Storm",
    "landslide": "Landslide",
    "tornado": "Tornado",
    "tsunami": "Tsunami",
    "thunderstorm": "Thunderstorm",
    "storm surge": "Storm Surge",
    "pandemic": "Pandemic",
    "wind": "Wind",
}
SIMULATION_TYPES = ("Earthquake", "Wind", "Other")
LICENCES = (
    "Open Data Commons Attribution",
    "Open Data Commons Public Domain Dedication",
    "Creative Commons Attribution",
    "Creative Commons Public Domain Dedication",
)
FACILITIES = {
    "rtmd-lehigh": "Real-Time Multi-Directional (RTMD) Experimental Facility with Large-Scale Hybrid Simulation Testing "
    "Capabilities - LeHigh University",
    "lhpost-sandiego": "Six Degree of Freedom Large High-Performance Outdoor Shake Table (LHPOST6) - University of California, "
    "San Diego",
    "uc-berkeley": "UC Berkeley",
    "ut-austin": "University of Texas at Austin",
}
