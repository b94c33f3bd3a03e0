"""Formats of data acquisition, test machines and simulation programs."""
