"""Stability of a plan's closed loop."""
