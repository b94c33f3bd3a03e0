"""What is shown of a result in each kind of test."""

KINDS = {
    "hybrid": "Real-time hybrid simulation",
    "specimen": "Test of a specimen",
    "actuator": "Test of an actuator",
    "structure": "Test of a structure alone",
}
# verdict of a diagnosis -> what it says
VERDICTS = {
    "consistent": "The recording is what the plan's models simulate, up to noise.",
    "recalibrate": "The plan's models fit once their own parameters are moved: no new physics.",
    "undetermined": "Something beyond noise remains, too small to tell what it is.",
    "mismatch": "The models leave physics out.",
    "configuration_error": "What the controller computed is not what the plan computes.",
}
