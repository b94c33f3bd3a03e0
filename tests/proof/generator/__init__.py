"""The generator of sealed recordings: its own equations, solved by SciPy at tight tolerance, without code of the engine."""
