"""Rigs: what tests run on, how many at a time, and the capacities of their actuators."""
