"""Diagnoses: comparisons of recordings with plans, executed in their own queue."""
