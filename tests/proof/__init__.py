"""Diagnosis proved on sealed recordings whose left-out physics is known."""
