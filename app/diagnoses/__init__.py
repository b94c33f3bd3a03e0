"""Diagnoses: compare a recording with a plan, in a queue of their own."""
