"""Titles of the kinds of test and sentences of the verdicts."""

KINDS = {
    "hybrid": "Real-time hybrid simulation",
    "specimen": "Test of a specimen",
    "actuator": "Test of an actuator",
    "structure": "Test of a structure alone",
    "client": "Test with a client",
}
# verdict of a diagnosis -> its sentence
VERDICTS = {
    "consistent": "The recording agrees with the plan's models up to noise.",
    "recalibrate": "The plan's models fit after their own parameters are recalibrated. No physics is left out.",
    "undetermined": "A mismatch beyond noise remains. It is too small to determine its cause.",
    "mismatch": "The plan's models leave out physics.",
    "configuration_error": "The signals that the controller computed differ from those that the plan computes.",
}
