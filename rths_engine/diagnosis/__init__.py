"""From "simulation and recording differ" to a better model: replay, detect, locate, select, verify, describe."""
