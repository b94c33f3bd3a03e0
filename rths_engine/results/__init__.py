"""The results of a run: its channels, its signals and its measures."""
