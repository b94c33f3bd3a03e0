"""The kinds of test that a plan can describe."""

TESTS = {
    "hybrid": "Hybrid: structure computed, specimens tested",
    "specimen": "Specimen: prescribed displacement",
    "actuator": "Actuator: tracking of a command",
    "structure": "Structure alone: ground motion, forces or free vibration",
    "client": "Client: another program computes the structure, the rig follows it",
}
DRIVEN = ("specimen", "actuator")  # one station follows the drive of the plan
FOLLOWING = (*DRIVEN, "client")  # no structure is computed
