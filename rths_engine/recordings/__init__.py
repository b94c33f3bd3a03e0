"""Files of recordings: those of runs, and measurements that were imported."""
