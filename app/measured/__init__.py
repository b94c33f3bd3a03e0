"""Measured recordings: upload a file, map its columns, import it."""
