"""Runs: submit, list, cancel and download."""
