"""Reports of runs and diagnoses, each a stand-alone HTML file."""
