"""What is shown of a result in each kind of test."""

KINDS = {
    "hybrid": "Real-time hybrid simulation",
    "specimen": "Test of a specimen",
    "actuator": "Test of an actuator",
    "structure": "Test of a structure alone",
}
# without a structure there is no energy to be fed into it
SILENT = {"specimen": ("mti_mm2", "mee_kNm", "energy_error_percent"), "actuator": ("mee_kNm", "energy_error_percent")}
