"""Times of runs and steps on this machine, and what they are compared with."""
