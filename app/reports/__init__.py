"""Reports of runs and diagnoses as HTML files that stand alone."""
