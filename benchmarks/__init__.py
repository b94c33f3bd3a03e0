"""Benchmarks: times of runs and steps on this machine, and their comparison with OpenSees and with memory bandwidth."""
