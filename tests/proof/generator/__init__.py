"""Sealed recordings: physics of its own, solved by SciPy at tight tolerance, without a line of the engine."""
