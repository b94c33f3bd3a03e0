"""Files of recordings: recordings of runs, and imported measurements."""
