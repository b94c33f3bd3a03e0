"""Diagnosis: compare a recording with a plan and improve its models (replay, detect, locate, select, verify, describe)."""
