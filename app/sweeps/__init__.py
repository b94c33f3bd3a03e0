"""Sweeps: preview, submit, list, cancel, resume and results."""
