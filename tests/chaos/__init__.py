"""Chaos: short runs and a sweep while everything under them is killed, filled, cut and turned back; see docs/chaos.md."""
