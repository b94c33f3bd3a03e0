"""Approvals: runs and sweeps that another person approves or rejects before they queue."""
