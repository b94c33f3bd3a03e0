"""Sweeps: many tests that differ in chosen fields of one plan, their execution, and the table of their measures."""
