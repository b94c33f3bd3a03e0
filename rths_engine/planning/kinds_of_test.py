"""The kinds of test that a plan can describe."""

TESTS = {
    "hybrid": "Hybrid: structure computed, specimens tested",
    "specimen": "Specimen: prescribed displacement",
    "actuator": "Actuator: tracking of a command",
    "structure": "Structure alone: ground motion, forces or free vibration",
}
DRIVEN = ("specimen", "actuator")
